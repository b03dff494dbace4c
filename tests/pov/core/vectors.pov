#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#declare V = <1, 2, 3>;
#debug concat(vstr(3, V, ",", 0, 1), " ", vstr(3, -V * 2 + 1, ",", 0, 1), "\n")
#debug concat(vstr(3, V * <2, 3, 4>, ",", 0, 1), " ", vstr(3, V / <2, 4, 8>, ",", 0, 4), "\n")
#debug concat(vstr(3, 10 / V, ",", 0, 4), " ", vstr(3, 1 - V, ",", 0, 1), "\n")
#debug concat(vstr(3, <1, 2> + V, ",", 0, 1), " ", vstr(3, 5 + <1, 2>, ",", 0, 1), "\n")
#debug concat(vstr(5, <1, 2, 3, 4, 5>, ",", 0, 1), " ", vstr(2, <1 2,>, ",", 0, 1), "\n")
#debug concat(str(V.x, 0, 0), str(V.y, 0, 0), str(V.z, 0, 0), str(V.u, 0, 0), str(V.v, 0, 0), "\n")
#declare V4 = <1, 2, 3, 4>;
#debug concat(str(V4.t, 0, 0), str(V4.filter, 0, 0), str(V4.blue, 0, 0), str(-V.x, 0, 0), "\n")
#debug concat(vstr(3, V.z, ",", 0, 1), " ", vstr(3, V.z + 0, ",", 0, 1), " ", vstr(3, 5, ",", 0, 1), "\n")
#debug concat(vstr(3, x + 2*y - z, ",", 0, 1), " ", vstr(2, u - v, ",", 0, 1), " ", vstr(4, t, ",", 0, 1), "\n")
#debug concat(str(vdot(V, <4, 5, 6>), 0, 1), " ", str(vlength(V), 0, 15), " ", vstr(3, vcross(x, y), ",", 0, 1), "\n")
#debug concat(vstr(3, vnormalize(V), ",", 0, 15), "\n")
#debug concat(vstr(3, vrotate(V, <10, 20, 30>), ",", 0, 14), "\n")
#debug concat(vstr(3, vaxis_rotate(V, <1, 1, 0>, 33), ",", 0, 14), "\n")
#debug concat(vstr(3, (V < <2, 2, 2>), ",", 0, 0), " ", str((x < y).x, 0, 0), " ", vstr(3, (1 ? V : x), ",", 0, 0), "\n")
#debug concat(vstr(3, vrotate(5, 90*x), ",", 0, 6), " ", vstr(3, vrotate(V.z, 90*x), ",", 0, 6), "\n")
