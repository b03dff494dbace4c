// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// blob: spheres and cylinders with strengths of either sign, transformed components, the old component
// statement, textures of components blended by their densities, and light through a blob of which some
// components are clear.
#include "stage.inc"
blob {
	threshold .6
	sphere { <-2, 1, 0>, 1, 2 pigment { rgb x } }
	sphere { <-1.3, 1.3, 0>, .7, strength 1.5 pigment { rgb y } finish { phong 1 } }
	cylinder { <-2, .5, -.5>, <-1, .3, -1>, .5, 1 pigment { rgb z } }
	sphere { <-1.8, 1.2, -.8>, .5, -2 pigment { rgb 1 } }
	pigment { rgb <.9, .3, .2> }
	finish { phong .5 }
}
blob {
	threshold .3
	sphere { 0, 1, 1 scale <1, .5, .6> rotate 30*z translate <0, 1, 0> }
	cylinder { <-.5, .5, -.5>, <.6, 1.4, -1>, .6, 1 scale <1, 1, .7> }
	component 1 .7 <.2, 1.5, 0>
	sturm
	pigment { rgb <.2, .9, .2> }
}
blob {
	threshold .5
	#local i = 0;
	#while (i < 14)
		sphere {
			<1.6 + .5*cos(i*1.3), .3 + .1*i, .5*sin(i*1.3)>, .55, 1 + .5*sin(i*2)
			#if (mod(i, 3) = 1) pigment { rgbt <1, .8, .2, .6> } #end
		}
		#local i = i + 1;
	#end
	pigment { rgb <.6, .5, .9> }
	finish { phong 1 }
}
