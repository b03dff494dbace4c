// Splines of every kind, with few points, odd ones, and points in any order.
#version 3.7;
global_settings { assumed_gamma 1 }
#macro Say(S, N)
	#local T = -1.5;
	#while (T < 5.6)
		#local W = S(T);
		#debug concat(vstr(N, W, " ", 0, 8), ", ")
		#local T = T + 0.375;
	#end
	#debug "; \n"
#end
#declare A = spline { linear_spline -1, <0, 1> 0, <1, 3> 1, <4, 2> 2.5, <7, 9> 4, <2, 2> 5, <0, 0> }
#declare B = spline { quadratic_spline -1, <0, 1> 0, <1, 3> 1, <4, 2> 2.5, <7, 9> 4, <2, 2> 5, <0, 0> }
#declare C = spline { cubic_spline -1, <0, 1> 0, <1, 3> 1, <4, 2> 2.5, <7, 9> 4, <2, 2> 5, <0, 0> }
#declare D = spline { natural_spline -1, <0, 1> 0, <1, 3> 1, <4, 2> 2.5, <7, 9> 4, <2, 2> 5, <0, 0> }
Say(A, 2) Say(B, 2) Say(C, 2) Say(D, 2)
#declare E1 = spline { 0, 1 }
#declare E2 = spline { cubic_spline 0, <1, 2> 2, <3, 5> }
#declare E3 = spline { quadratic_spline 0, <1, 2> 2, <3, 5> }
#declare E4 = spline { natural_spline 0, <1, 2> 2, <3, 5> }
#declare E5 = spline { cubic_spline 0, <1, 2> 2, <3, 5> 3, <0, 1> }
Say(E1, 2) Say(E2, 2) Say(E3, 2) Say(E4, 2) Say(E5, 2)
#declare G = spline { 2, <3, 4, 5> 1, <2, 3, 0> 0, <1, 0, 9> 2, <3, 5, 6> 3, <0, 0, 1> 1, x }
#declare H = spline { G 4, <9, 8, 7> }
Say(G, 3) Say(H, 3)
#declare I = spline { natural_spline 0, <1, 2, 3, 4, 5> 1, <5, 4, 3, 2, 1> 2.5, <0, 1, 0, 1, 0> }
Say(I, 5)
#debug concat(str(A(0.25).y, 0, 8), " ", str(vlength(G(0.5)), 0, 8), " ", str(A(0.25, natural_spline).x, 0, 8), " ")
#debug concat(vstr(3, G(0.5) * 2 + x, " ", 0, 8), "\n")
