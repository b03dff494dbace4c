#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#declare A = array[2][3] { {1, 2, 3}, {4, 5, 6,}, }
#debug concat(str(dimensions(A), 0, 0), str(dimension_size(A, 1), 0, 0), str(dimension_size(A, 2), 0, 0), str(dimension_size(A, 3), 0, 0), "\n")
#debug concat(str(A[0][0], 0, 0), str(A[1][2], 0, 0), str(A[1.9][0], 0, 0), str(A [ 0 ] [ 1 ], 0, 0), "\n")
#declare A[0][1] = 9;
#declare B = A;
#declare B[0][1] = 8;
#debug concat(str(A[0][1], 0, 0), str(B[0][1], 0, 0), "\n")
#declare V = array[3];
#declare V[0] = <1, 2, 3>;
#declare V[1] = <4, 5, 6>;
#debug concat(vstr(3, V[0] + V[1], ",", 0, 0), " ", str(V[1].y, 0, 0), "\n")
#declare S = array[2] { "ab", "cd" }
#debug concat(S[0], S[1], "\n")
#declare N = array[3] { 2, 0, 1 }
#debug concat(str(N[N[N[0]]], 0, 0), "\n")
#macro Fill(T, E) #local I = 0; #while (I < dimension_size(T, 1)) #declare T[I] = I * I; #local I = I + 1; #end #declare E = -1; #end
#declare F = array[4] { 0, 0, 0, 0 }
Fill(F, N[1])
#debug concat(str(F[3], 0, 0), str(N[1], 0, 0), "\n")
#macro Of(T, I) T[I] #end
#debug concat(str(Of(F, 2), 0, 0), "\n")
