#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Data files of scenes: what is read and written is what POV-Ray 3.7 reads and writes, and only where a scene
# may.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
mkdir out sub

read_it()
{
	"$ALIDADE" -vv --dry-run "$@" 2>&1 >/dev/null | sed -n 's/^alidade: debug: //p; s/^alidade: \(.*error: \)/\1/p' |
		tr '\n' '|'
}

cat >write.pov <<'END'
#fopen F "out.txt" write
#write (F, 1/3, ",", 1e-7, ",", 123456789.123, <1,2/3,3>, ",", <1,2>, "text", ",\"quoted\"", "\n")
#declare G = 7; #declare V = <1,2,3>;
#write (F 5 "a" 6 V, G, V.x * 2, sqrt(2), x, 2 * y)
#fclose F
#ifdef (F) #error "still open" #end
#fopen F "out.txt" append
#write (F, concat("b", "c"), str(3, 0, 2), "\n")
END
ok "writing" "$ALIDADE" -q --dry-run --write=out write.pov
# As POV-Ray wrote it.
cat >want.txt <<'END'
0.333333,1e-07,1.23457e+08<1,0.666667,3> ,<1,2> text,"quoted"
5a6<1,2,3> 721.41421<1,0,0> <0,2,0> bc3.00
END
ok "gives what POV-Ray writes" cmp want.txt out/out.txt
is "is not done unasked" "$(read_it write.pov | cut -d: -f1,2,3,4,5)" \
	'write.pov:1:1: error: the scene wants to write the file "out.txt"; --write=DIR lets it write into DIR, --lenient goes on without|'
ok "or left out" "$ALIDADE" -q --dry-run --lenient write.pov
ok "and nothing was written" test ! -e out.txt
echo '#fopen F "../x.txt" write' >up.pov
ok "not above" fails 3 "$ALIDADE" -q --dry-run --write=out up.pov
echo '#fopen F "/tmp/x.txt" write' >up.pov
ok "not elsewhere" fails 3 "$ALIDADE" -q --dry-run --write=out up.pov
ln -s "$PWD/sub" out/link.txt
echo '#fopen F "link.txt" append' >up.pov
ok "not through links" fails 3 "$ALIDADE" -q --dry-run --write=out up.pov

cat >read.pov <<'END'
#fopen F "data.txt" read
#while (defined (F))
	#read (F, A, B)
	#debug concat(str(defined(A), 0, 0), str(defined(B), 0, 0), str(defined(F), 0, 0), "\n")
#end
END
# Which of A, B and the file were there after each #read, as POV-Ray says.
row()
{
	printf %b "$1" >data.txt
	is "reading $(printf %s "$1" | tr -d "\\\\")" "$(read_it read.pov)" "$2"
}
row '1,2,3' '111|110|'
row '1,2,3,' '111|110|'
row '1,2' '110|'
row '1' '100|'
row '1,-2,3\n' '111|110|'
row '1,// c\n2,/* x */3,4' '111|110|'
row '1 2' 'data.txt:1:3: error: expected a comma between two values of the data file|'
row 'x' 'data.txt:1:1: error: expected a float, a vector or a string in the data file|'
cat >values.pov <<'END'
#fopen F "data.txt" read
#read (F, A, B, C, D)
#debug concat(A, vstr(3, B, " ", 0, 2), str(C, 0, 2), vstr(2, D, " ", 0, 2), "\n")
END
printf '"a\\tb",<1,-2,+3>,+.5e1,<4,5>' >data.txt
is "values" "$(read_it values.pov)" "a	b1.00 -2.00 3.005.004.00 5.00|"
mv data.txt sub
is "a folder of -L" "$(read_it -L sub values.pov)" "a	b1.00 -2.00 3.005.004.00 5.00|"
echo '#fopen F "../data.txt" read' >sub/up.pov
is "reading above" "$(read_it sub/up.pov | cut -d: -f4-6)" \
	' error: "../data.txt": a scene may read files only below its own folder and those of -L|'
tap_done
