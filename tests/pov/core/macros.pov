#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#macro M(A) #declare A = A + 1; #local Q = 7; #declare G = Q; #declare Q = 8; Q #end
#declare P = 5;
#declare R = M(P);
#debug concat(str(P, 0, 0), " ", str(R, 0, 0), " ", str(G, 0, 0), " ", str(defined(Q), 0, 0), "\n")
#declare R = M(5);
#declare R = M(P + 0);
#debug concat(str(P, 0, 0), "\n")
#macro Lo(A) #local A = A + 1; #declare R = A; #end
Lo(P)
#debug concat(str(P, 0, 0), " ", str(R, 0, 0), "\n")
#macro Fact(N) #if (N < 2) 1 #else N * Fact(N - 1) #end #end
#debug concat(str(Fact(10), 0, 0), "\n")
#macro Early(A) #if (A) 1 #break #end 2 #end
#debug concat(str(Early(1), 0, 0), str(Early(0), 0, 0), "\n")
#macro Three() <1, 2, 3> #end
#macro Sum(A, B) (A + B) #end
#debug concat(vstr(3, Sum(Three(), Three()) * 2, ",", 0, 1), "\n")
#macro Ret() #local L = 5; L #end
#declare Z = Ret() + Ret() * 2;
#debug concat(str(Z, 0, 0), str(defined(L), 0, 0), "\n")
#macro Twice(S) concat(S, S) #end
#debug concat(Twice(Twice("ab")), "\n")
#macro Outer(A) #local V = 1; Inner() #end
#macro Inner() #debug concat("sees ", str(V, 0, 0), "\n") #declare V = 2; #local V = 3; #end
#declare V = 10;
Outer(0)
#debug concat("global ", str(V, 0, 0), "\n")
#macro Loop(N) #local I = 0; #while (I < N) #debug concat(str(I, 0, 0), " ") #local I = I + 1; #end #end
#declare I = 77;
Loop(3)
#debug concat(str(I, 0, 0), "\n")
#macro Pieces() 1, 2 #end
#debug concat(str(max(Pieces(), 3, Pieces()), 0, 0), " ", vstr(2, <Pieces()>, ",", 0, 0), "\n")
#macro Sw(N) #switch (N) #case (1) "one" #break #case (2) "two" #break #else "many" #end #end
#debug concat(Sw(1), Sw(2), Sw(3), "\n")
#macro Sw(N) "redefined" #end
#debug concat(Sw(1), "\n")
#macro Swap(A, B) #local T = A; #declare A = B; #declare B = T; #end
#declare One = 1; #declare Two = 2;
Swap(One, Two)
#debug concat(str(One, 0, 0), str(Two, 0, 0), "\n")
#macro Pass(A) M2(A) #end
#macro M2(B) #declare B = B * 10; #end
Pass(One)
#debug concat(str(One, 0, 0), "\n")
#declare B = sphere { 0, 1 }
#macro Grow(S) #declare S = object { S scale 2 } #local Gone = box { 0, 1 }
#end
Grow(B)
#debug concat(str(defined(Gone), 0, 0), "\n")
