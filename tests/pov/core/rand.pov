#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#declare S = seed(42);
#declare T = seed(-1);
#declare U = seed(123456789.9);
#for (I, 1, 5)
	#debug concat(str(rand(S), 0, 15), " ", str(rand(T), 0, 15), " ", str(rand(U), 0, 15), "\n")
#end
#debug concat(str(S, 0, 0), str(T, 0, 0), str(U, 0, 0), "\n")
