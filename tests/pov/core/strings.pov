#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#declare S = "hello";
#debug concat(S, " ", strupr("aBc1"), strlwr("aBc1"), " ", substr(S, 2, 3), substr(S, 1, 1), "|", substr(S, 5, 1), "\n")
#debug concat(str(strlen("a\tb\"c"), 0, 0), str(strlen(""), 0, 0), " ", "q\"q", " ", "\u0041", "\\", "\n")
#debug concat(str(asc("A"), 0, 0), chr(66), str(asc(S), 0, 0), " ", str(val("3.5abc"), 0, 3), str(val("-1e2"), 0, 1), str(val("x"), 0, 1), "\n")
#debug concat(str((strcmp("abc", "abd") < 0), 0, 0), str((strcmp("b", "a") > 0), 0, 0), str(strcmp("a", "a"), 0, 0), "\n")
#debug concat(str(("a" = "a"), 0, 0), str(("a" < "b"), 0, 0), str((S != "hello"), 0, 0), str(("b" >= "a"), 0, 0), "\n")
#debug concat(str(12345.678, 15, 2), "|", str(12345.678, -15, 2), "|", str(2.5, 0, 0), str(3.5, 0, 0), "|", str(-7, -5, 1), "|", str(1/3, 0, -1), "|", str(1e20, 0, 0), "\n")
#debug concat(vstr(3, <1, -2, 3.5>, "; ", 6, 2), "|", vstr(2, <1, 2>, "", -4, 0), "\n")
#debug concat(str(file_exists("colors.inc"), 0, 0), str(file_exists("no such file"), 0, 0), "\n")
#declare T = concat(S, S);
#debug T
#debug "\n"
#macro M(X) concat("<", X, ">") #end
#debug concat(M("a"), M(S), M(M("b")), "\n")
