#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#declare A = array[12] { .04045, .9, .1, .2, .5, .02, .3, .039, .0395, .7, .8, 1.5 }
#for (I, 0, 11)
	#declare C = srgb A[I];
	#debug concat(str(C.red, 0, 9), " ")
#end
#debug "\n"
