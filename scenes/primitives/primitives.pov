#version 3.7;
#declare Default_texture = texture{pigment {rgb 0.8} finish {brilliance 3.8} }

global_settings {
assumed_gamma 1.0
max_trace_level 5
}
#declare CURFRAMENUM = 1;
//#include "/home/user/directory/animation_include_file.inc"
background {rgbt<0.35, 0.45, 0.6, 0>}
#declare camLocation  = <0.600000, 3.300000, 7.200000>;
#declare camLookAt = <-19.984874, 4.635465, 0.000000>;
camera {
location  <0, 0, 0>
look_at  <0, 0, -1>
right <-1.3333333333333333, 0, 0>
up <0, 1, 0>
angle  50.692352
rotate  <-19.984874, 4.635465, 0.000000>
translate <0.600000, 3.300000, 7.200000>
}
light_source {
< 0,0,0 >
color srgb<1, 1, 1>
fade_distance 6.708204
fade_power 2
matrix <0.857493, -0.000000, -0.514496,  -0.368964, 0.696932, -0.614940,  0.358569, 0.717137, 0.597614,  3.000000, 6.000000, 5.000000>
}
#declare lampTarget1= vrotate(<-3,5,-6>,<0.7711,2.295e-08,0.5404>);
light_source {
< 0,0,0 >
color srgb<0.35, 0.35, 0.42>
parallel
point_at  <0, 0, -1>
matrix <0.514496, 0.000000, 0.857493,  0.614940, 0.696932, -0.368964,  -0.597614, 0.717137, 0.358568,  -5.000000, 6.000000, 3.000000>
}
#declare lampTarget2= vrotate(<5,3,-6>,<0.7711,-4.165e-08,-1.03>);
#default{ pigment{ color srgb 0.8 }}

#declare shader_ = finish {
diffuse 0.8
phong 70.0
}

#declare DATAPovBox = box { -1,1
}
#declare DATAPovBox_001 = box { -1,1
}
#declare DATAPovCone = cone { <0,0,-0.7000>,0.7000,<0,0,0.7000>,0.2500
}
#declare DATAPovCone_001 = cone { <0,0,-0.5000>,0.5000,<0,0,0.5000>,0.0000
}
#declare DATAPovCylinder = cylinder { <0,0,0>,<0.400000,0.200000,1.500000>,0.450000
}
#declare DATAPovInfinitePlane = plane{ <0,0,1>,0
}
#declare DATAPovSphere = sphere { 0,0.800000
}
#declare DATAPovSphere_001 = sphere { 0,0.500000
}
#declare DATAPovTorus = torus { 0.4500,0.1500
rotate x*90
}

//----Blender Object Name: PovBox----
object { 
DATAPovBox
matrix <0.543785, -0.000000, -0.253571, -0.295833, -0.000000, -0.634415, 0.000000, 0.600000, -0.000000, -0.400000, 0.650000, -1.200000>

}

//----Blender Object Name: PovBox_001----
object { 
DATAPovBox_001
matrix <0.138854, -0.128558, -0.064749, -0.441051, 0.186231, -1.315596, -0.194130, -0.226322, 0.033044, 2.900000, 1.200000, -2.000000>

}

//----Blender Object Name: PovCone----
object { 
DATAPovCone
matrix <1.000000, 0.000000, 0.000000, 0.000000, -0.000000, -1.000000, 0.000000, 1.000000, -0.000000, 2.600000, 0.750000, 0.600000>

}

//----Blender Object Name: PovCone_001----
object { 
DATAPovCone_001
matrix <0.965926, 0.258819, -0.000000, 0.000000, -0.000000, -1.000000, -0.258819, 0.965926, -0.000000, -2.900000, 0.550000, 1.400000>

}

//----Blender Object Name: PovCylinder----
object { 
DATAPovCylinder
matrix <1.000000, 0.000000, 0.000000, 0.000000, -0.000000, -1.000000, 0.000000, 1.000000, -0.000000, 1.200000, 0.050000, 0.400000>

}

//----Blender Object Name: PovInfinitePlane----
object { 
DATAPovInfinitePlane
matrix <1.000000, 0.000000, 0.000000, 0.000000, -0.000000, -1.000000, 0.000000, 1.000000, -0.000000, 0.000000, -0.020000, 0.000000>

}

//----Blender Object Name: PovSphere----
object { 
DATAPovSphere
matrix <1.000000, 0.000000, 0.000000, 0.000000, -0.000000, -1.000000, 0.000000, 1.000000, -0.000000, -2.600000, 0.850000, -0.500000>

}

//----Blender Object Name: PovSphere_001----
object { 
DATAPovSphere_001
matrix <1.302076, -0.547232, -0.751754, -0.350000, -0.000000, -0.606218, 0.296198, 0.939693, -0.171010, -1.000000, 0.600000, 1.300000>

}

//----Blender Object Name: PovTorus----
object { 
DATAPovTorus
matrix <1.300000, 0.000000, 0.000000, 0.000000, 0.111338, -0.792214, 0.000000, 1.188322, 0.167008, 1.100000, 0.300000, 2.000000>

}

//----Blender Object Name: PovTorus----
object { 
DATAPovTorus
matrix <0.965926, -0.258819, 0.000000, 0.243210, 0.907673, -0.342020, 0.088521, 0.330366, 0.939693, 0.600000, 0.950000, -2.900000>

}
