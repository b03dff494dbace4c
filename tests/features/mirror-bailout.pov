// A metal's tint does not shrink the weight that adc_bailout stops at; the fresnel term does.
#version 3.7;
global_settings { assumed_gamma 1.0 }
background { rgb 4 }
camera { orthographic angle 20 location <0, 10, 0.01> look_at 0 right -x * 10 up y * 7.5 }
#declare Step = 0;
#while (Step < 8)
	box {
		<-0.5, -1, -3>, <0.5, 0, 3>
		pigment { rgb <0.9, 0.15, 0.2> }
		finish { ambient 0 diffuse 0 reflection { rgb <0.1, 0.12 + 0.08 * Step, 0.1> fresnel 1 metallic 1 } }
		interior { ior 1.3 }
		translate x * (1.2 * Step - 4.2)
	}
	#declare Step = Step + 1;
#end
