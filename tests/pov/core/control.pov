#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#if (0) #debug "no" #else #debug "yes" #end
#if (1) #debug " yes" #elseif (1) #debug "no" #else #debug "no" #end
#if (0) "skipped { # strings" #elseif (0) #debug "no" #elseif (2) #debug " yes" #else #debug "no" #end
#if (1e-11) #debug "no" #end
#ifdef (Unknown) #debug "no" #else #debug " undefined" #end
#declare Known = 1;
#ifndef (Known) #debug "no" #elseif (1) #debug " elseif" #end
#if (0) #if (1) #debug "no" #else #debug "no" #end #while (1) #end #for (I, 1, 2) #end #macro X() #end #else #debug " nested\n" #end
#switch (3)
	#case (1) #debug "one "
	#case (3) #debug "three "
	#range (5, 6) #debug "falls "
	#break
	#else #debug "else "
#end
#switch (5.5) #case (5) #debug "no" #range (5, 6) #debug "range " #break #case (7) #debug "no" #end
#switch (9) #case (5) #debug "no" #break #else #debug "else\n" #end
#declare I = 0;
#while (I < 10) #declare I = I + 1; #if (I = 3) #break #end #debug concat(str(I, 0, 0), " ") #end
#debug concat("then ", str(I, 0, 0), "\n")
#declare I = 0;
#while (I < 3)
	#declare J = 0;
	#while (J < 2) #debug concat(str(I, 0, 0), str(J, 0, 0), " ") #declare J = J + 1; #end
	#declare I = I + 1;
#end
#debug "\n"
#for (I, 0, 1, 0.1) #debug concat(str(I, 0, 17), " ") #end
#debug concat("left ", str(I, 0, 15), "\n")
#for (I, 10, 0, -2.5) #debug concat(str(I, 0, 1), " ") #end
#debug concat("left ", str(I, 0, 1), "\n")
#for (I, 1, 0) #debug "never" #end
#debug concat("left ", str(I, 0, 1), "\n")
#for (I, 1, 5) #if (I = 2) #declare I = 4; #end #if (I = 5) #break #end #debug concat(str(I, 0, 0), " ") #end
#debug "\n"
#declare A = 5;
#debug concat(str(A #if (0) + 1 #else + 2 #end , 0, 0), " ", str(A, 0, 0), "\n")
#declare X = 1; # declare Y = 2; #
declare Z = 3;
#debug concat(str(X + Y + Z, 0, 0), "\n")
/* comments /* nest */ #debug "no" */ // #debug "no"
#undef X
#ifdef (X) #debug "no" #else #debug "gone\n" #end
