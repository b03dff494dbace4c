dnl SPDX-FileCopyrightText: 2026 The Alidade authors
dnl SPDX-License-Identifier: Apache-2.0
dnl
dnl ALIDADE_FLAGS: warnings and the arithmetic rules (R5), for AM_CFLAGS; the user's CFLAGS stay theirs.
dnl -fno-strict-aliasing: components of a vector are taken as (&v.x)[k], from which clang 14 concludes that a
dnl store there changes x only (seen in tests/unit/test_kernel).
AC_DEFUN([ALIDADE_FLAGS], [
ALIDADE_CFLAGS="-std=c17 -ffp-contract=off -fno-math-errno -fno-strict-aliasing"
ALIDADE_CFLAGS="$ALIDADE_CFLAGS -fvisibility=hidden"
ALIDADE_CFLAGS="$ALIDADE_CFLAGS -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wstrict-prototypes"
ALIDADE_CFLAGS="$ALIDADE_CFLAGS -Wmissing-prototypes -Wvla -Wdouble-promotion"
ALIDADE_CXXFLAGS="-std=c++17 -fvisibility=hidden -Wall -Wextra"
AC_ARG_ENABLE([werror], [AS_HELP_STRING([--enable-werror], [treat warnings as errors])],
	[AS_IF([test "x$enableval" = xyes], [ALIDADE_CFLAGS="$ALIDADE_CFLAGS -Werror"
		ALIDADE_CXXFLAGS="$ALIDADE_CXXFLAGS -Werror"])])
AC_ARG_ENABLE([sanitizers],
	[AS_HELP_STRING([--enable-sanitizers], [build with AddressSanitizer and UBSan])],
	[AS_IF([test "x$enableval" = xyes], [
		ALIDADE_SAN="-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer"
		ALIDADE_CFLAGS="$ALIDADE_CFLAGS $ALIDADE_SAN"
		ALIDADE_CXXFLAGS="$ALIDADE_CXXFLAGS $ALIDADE_SAN"
		ALIDADE_LDFLAGS="$ALIDADE_SAN"])])
AC_SUBST([ALIDADE_CFLAGS])
AC_SUBST([ALIDADE_CXXFLAGS])
AC_SUBST([ALIDADE_LDFLAGS])
])
