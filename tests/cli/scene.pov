// A scene of a few primitives for the tests of the command line.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }
#ifndef (Turn) #declare Turn = 0; #end
camera { perspective location <0, 1, -4> look_at <0, 0.3, 0> }
light_source { <3, 5, -4> color rgb <1, 1, 1> }
light_source { <-4, 3, -2> color rgb <0.3, 0.3, 0.4> shadowless }
background { color rgb <0.05, 0.07, 0.1> }
sphere { <0, 0.5, 0>, 0.8
	pigment { color rgb <0.8, 0.2, 0.1> }
	finish { ambient 0 diffuse 0.7 specular 0.4 roughness 0.02 reflection { 0.2 } }
	rotate y * 90 * Turn
}
box { <-2, -0.4, -2>, <2, -0.3, 2>
	pigment { color rgb <0.6, 0.6, 0.6> }
	finish { ambient 0 diffuse 0.8 }
}
