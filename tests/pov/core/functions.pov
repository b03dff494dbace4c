// User functions, called while the scene is read: numbers, precedence, sums, and what they are made of.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "functions.inc"
#macro Say(F, A, B, C) #debug concat(str(F(A, B, C), 0, 9), " ") #end
#macro Try(F) Say(F, 0.5, -1.25, 2) Say(F, 0, 0, 0) Say(F, -3, 0.1, 7.5) #debug "; " #end
#declare A1 = array[2] { 5, 6 };
#declare Three = 3;
#declare F01 = function { x + y * z - x / 4 }  Try(F01)
#declare F02 = function { 1 - 2 - Three * x / 2 / 2 }  Try(F02)
#declare F03 = function { (x < y) + (x <= z) * 10 + (x = 0) * 100 + (y != 0.1) * 1000 + (z > x) * 1e4 + (z >= 7.5) * 1e5 }  Try(F03)
#declare F04 = function { (x & y) + 2 * (x | y) + 4 * (x < y = 1) + 8 * (3 > x > y) }  Try(F04)
#declare F05 = function { -x * -y + -2 - +z }  Try(F05)
#declare F06 = function { 1 / x }  Try(F06)
#declare F07 = function { sqrt(x) }  Say(F07, 2, 0, 0) Say(F07, 0, 0, 0)
#declare F08 = function { pow(z, 2) + mod(z, 3) + int(y) + floor(y) + ceil(y) + div(z, 2) + abs(x) }  Try(F08)
#declare F09 = function { sin(x) + cos(y) + tan(z) + sinh(x) + cosh(y) + tanh(z) + asinh(x) + atan(y) + atan2(x, z) }  Try(F09)
#declare F10 = function { exp(x) + radians(y) + degrees(z) + asin(x / 9) + acos(y / 9) + acosh(z + 9) + atanh(x / 9) }  Try(F10)
#declare F11 = function { ln(z + 1) + log(z + 1) + pi + clock }  Try(F11)
#declare F12 = function { min(x, y, z) + 10 * max(x, 3, y) }  Try(F12)
#declare F13 = function { select(x, 1, 2) + 10 * select(y, 1, 2, 3) }  Try(F13)
#declare F14 = function { sum(i, 1, 10, i * x) + prod(i, 1, 5, i + y) + sum(i, 1, 3, sum(j, 1, i, i * j + z)) }  Try(F14)
#declare F15 = function { sum(i, x, x + 2.5, i) + sum(i, 3, 1, i) + prod(i, 3, 1, i) }  Try(F15)
#declare F16 = function { sum(x, 1, 3, x) + x + u + v }  Try(F16)
#declare F17 = function (a, b, c) { F01(c, b, a) * 2 + A1[1] }  Try(F17)
#declare F18 = function (x, x, z) { x + z }  Try(F18)
#declare F19 = function { transform { rotate <10, 20, 30> translate x } }
#declare F20 = function { F19(x, y, z).x + F19(x, y, z).y * F19(x, y, z).z + F19(y, z, x).u }  Try(F20)
#declare F21 = function { pigment { gradient x color_map { [0 rgbft <1, .25, .5, .75, .125>] [1 rgb 0] } } }
#declare F22 = function { F21(x, y, z).red + 2 * F21(x, y, z).t + 4 * F21(x, y, z).transmit }  Try(F22)
#debug concat(vstr(5, F21(.5, 0, 0), " ", 0, 6), " ", str(F21(.25, 0, 0).blue, 0, 6), " ")
#declare F23 = function { pattern { gradient x triangle_wave frequency 2 phase .2 scale 3 } }  Try(F23)
#declare F24 = function { pattern { brick } }  Try(F24)
#declare F25 = function { pattern { crackle turbulence .3 scale .2 } }  Try(F25)
#declare F26 = function { f_noise3d(x, y, z) + f_noise_generator(x, y, z, 1) + f_noise_generator(x, y, z, 3) + f_noise_generator(x, y, z, 0) }  Try(F26)
#declare F27 = function { f_sphere(x, y, z, .3) + f_torus(x, y, z, 2, .5) + f_ellipsoid(x, y, z, 1, 2, 3) }  Try(F27)
#declare F28 = function { f_rounded_box(x, y, z, .2, 1, 2, .7) + f_superellipsoid(x, y, z, .7, 1.4) }  Try(F28)
#declare F29 = function { f_helix1(x, y, z, 2, 3, .4, .8, 1.5, .5, 20) + f_helix1(x, y, z, 1, 3, .4, .8, 1.5, 0, 0) }  Try(F29)
#declare F30 = function { f_ridged_mf(x, y, z, .1, 3, 7, .7, .7, 2) }  Try(F30)
#declare F31 = function { f_r(x, y, z) + f_th(x, y, z) * f_ph(x, y, z) }  Try(F31)
#macro Twice() (x * 2) #end
#declare F32 = function { Twice() #local I = 0; #while (I < 3) + I * z #local I = I + 1; #end }  Try(F32)
#debug "\n"
