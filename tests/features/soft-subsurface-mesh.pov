// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A bumpy mesh2 with smooth normals: cosines, base points and ways in go by these.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10 subsurface { samples 200, 25 } }
camera { location <0.5, 1.2, -4> look_at 0 angle 36 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <2, 3, 6> rgb 1.5 }
light_source { <-3, 4, -5> rgb <0.3, 0.4, 0.2> }
plane { y, -1.1 pigment { rgb 0.5 } }
#declare N = 24;
#declare M = 12;
#macro Point(I, J)
	#local A = 2 * pi * I / N;
	#local B = pi * J / M;
	#local R = 1 + 0.12 * sin(5 * A) * pow(sin(B), 2) + 0.08 * cos(6 * B);
	(R * <cos(A) * sin(B), cos(B), sin(A) * sin(B)>)
#end
#macro Normal(I, J)
	#if (J = 0 | J = M) <0, 2 * J - M, 0> #else
	vcross(Point(I, J + 0.1) - Point(I, J - 0.1), Point(I + 0.1, J) - Point(I - 0.1, J))
	#end
#end
mesh2 {
	vertex_vectors { (M + 1) * N #for (J, 0, M) #for (I, 0, N - 1) , Point(I, J) #end #end }
	normal_vectors { (M + 1) * N #for (J, 0, M) #for (I, 0, N - 1) , -Normal(I, J) #end #end }
	face_indices {
		2 * N * (M - 1)
		#for (J, 0, M - 1) #for (I, 0, N - 1)
			#local K = mod(I + 1, N);
			#if (J < M - 1) , <J * N + I, (J + 1) * N + I, (J + 1) * N + K> #end
			#if (J > 0) , <J * N + I, (J + 1) * N + K, J * N + K> #end
		#end #end
	}
	pigment { rgb <0.8, 0.6, 0.4> }
	finish { ambient 0 diffuse 0.9 phong 0.3 subsurface { translucency <3, 2, 1> } }
	interior { ior 1.4 }
}
