#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { }
#debug concat(str(1/3, 0, 17), " ", str(.5, 0, 3), " ", str(5., 0, 3), " ", str(1.5e3, 0, 3), "\n")
#debug concat(str(1e-7, 0, 12), " ", str(123456789.123456789, 0, 9), " ", str(1E2, 0, 1), "\n")
#debug concat(str(0.1 + 0.2, 0, 20), " ", str(2 + 3 * 4, 0, 0), " ", str((2 + 3) * 4, 0, 0), "\n")
#debug concat(str(5 - 3 - 1, 0, 0), " ", str(16 / 4 / 2, 0, 0), " ", str(-2 * -3 + -4, 0, 0), "\n")
#debug concat(str(- - 5, 0, 0), " ", str(+5, 0, 0), " ", str(!0, 0, 0), str(!5, 0, 0), str(!1e-11, 0, 0), "\n")
#debug concat(str((1 < 2), 0, 0), str((2 <= 2 - 1e-12), 0, 0), str((1e-11 = 0), 0, 0), "\n")
#debug concat(str((1 != 1 + 1e-11), 0, 0), str((2 >= 2 + 1e-12), 0, 0), str((3 > 2), 0, 0), "\n")
#debug concat(str((1 < 2 & 2 < 1), 0, 0), str((1 < 2 | 2 < 1), 0, 0), str((1 & 0 | 1), 0, 0), "\n")
#declare A = 3;
#debug concat(str((A = 3 ? 10 : 20), 0, 0), " ", str((A = 2 ? 1 : A = 3 ? 2 : 3), 0, 0), "\n")
#debug concat(str(abs(-3), 0, 0), " ", str(ceil(-2.5), 0, 0), " ", str(floor(-2.5), 0, 0), "\n")
#debug concat(str(int(-2.7), 0, 1), " ", str(int(2.7), 0, 1), " ", str(int(3e9), 0, 1), "\n")
#debug concat(str(div(-7, 2), 0, 1), " ", str(mod(-7, 3), 0, 1), " ", str(mod(7.5, 2), 0, 1), "\n")
#debug concat(str(sin(1), 0, 15), " ", str(cos(1), 0, 15), " ", str(tan(1), 0, 15), "\n")
#debug concat(str(asin(.5), 0, 15), " ", str(acos(.5), 0, 15), " ", str(atan(.5), 0, 15), "\n")
#debug concat(str(sinh(1), 0, 15), " ", str(cosh(1), 0, 15), " ", str(tanh(1), 0, 15), "\n")
#debug concat(str(asinh(1), 0, 15), " ", str(acosh(2), 0, 15), " ", str(atanh(.5), 0, 15), "\n")
#debug concat(str(exp(1), 0, 15), " ", str(ln(2), 0, 15), " ", str(log(2), 0, 15), "\n")
#debug concat(str(pow(2, .5), 0, 15), " ", str(sqrt(2), 0, 15), "\n")
#debug concat(str(atan2(1, -1), 0, 15), " ", str(degrees(1), 0, 12), " ", str(radians(1), 0, 15), "\n")
#debug concat(str(min(3, 1, 2), 0, 0), str(max(3, 1, 2), 0, 0), str(max(4), 0, 0), "\n")
#debug concat(str(bitwise_and(12, 10), 0, 0), " ", str(bitwise_or(12, 3, 16), 0, 0), " ",
	      str(bitwise_xor(12, 10), 0, 0), " ", str(bitwise_and(-1, 255.9), 0, 0), "\n")
#debug concat(str(select(-1, 1, 2, 3), 0, 0), str(select(0, 1, 2, 3), 0, 0), str(select(1, 1, 2, 3), 0, 0),
	      str(select(-1, 1, 2), 0, 0), str(select(0, 1, 2), 0, 0), "\n")
#debug concat(str(pi, 0, 15), " ", str(true + yes + on, 0, 0), str(false + no + off, 0, 0), "\n")
#debug concat(str(clock, 0, 2), " ", str(clock_on, 0, 0), " ", str(frame_number, 0, 0), "\n")
#debug concat(str(initial_frame, 0, 0), str(final_frame, 0, 0), str(clock_delta, 0, 0), "\n")
#debug concat(str(version, 0, 3), "\n")
#version 3.5;
#debug concat(str(version, 0, 3), "\n")
#declare Old = version;
#version 3.7;
#version Old;
#debug concat(str(version, 0, 3), "\n")
