//----------------------------------------------
//--Exported with POV-Ray exporter for Blender--
//----------------------------------------------

#version 3.7;
#declare Default_texture = texture{pigment {rgb 0.8} finish {brilliance 3.8} }


//--Global settings--

global_settings {
    assumed_gamma 1.0
    max_trace_level 5
    radiosity {
        adc_bailout 0.0039
        brightness 1
        count 35
        error_bound 10
        gray_threshold 0
        low_error_factor 0.5
        maximum_reuse 0.2
        minimum_reuse 0.015
        nearest_count 1
        pretrace_start 0.04
        pretrace_end 0.004
        recursion_limit 1
        always_sample 0
        normal 0
        media 1
        subsurface 0
    }
    ambient_light rgb<0, 0, 0>
}

//--Custom Code--

#declare CURFRAMENUM = 1;
//#include "/home/user/directory/animation_include_file.inc"

//--Patterns Definitions--


//--Background--

background {rgbt<0.0509, 0.0509, 0.0509, 0>}

//--Cameras--

#declare camLocation  = <7.358891, 4.958310, 6.925791>;
#declare camLookAt = <-26.440706, 46.691945, -0.000003>;
camera {
    location  <0, 0, 0>
    look_at  <0, 0, -1>
    right <-1.7777777777777777, 0, 0>
    up <0, 1, 0>
    angle  39.597753
    rotate  <-26.440706, 46.691945, -0.000003>
    translate <7.358891, 4.958310, 6.925791>
}

//--Lamps--

light_source {
    < 0,0,0 >
    color srgb<1, 1, 1>
    fade_distance 3.872982
    fade_power 2
    matrix <-0.290865, -0.055189, -0.955171,  -0.771101, 0.604525, 0.199883,  0.566393, 0.794672, -0.218391,  4.076245, 5.903862, -1.005454>
}
#declare lampTarget1= vrotate(<-4.076,-1.005,-5.904>,<0.6503,0.05522,1.866>);

//--Rainbows--


//--Special Curves--


//--Material Definitions--

#default{ pigment{ color srgb 0.8 }}
//--translation of spec and mir levels for when no map influences them--
#declare shader_ = finish {
    diffuse 0.8
    phong 70.0
}

//--translation of spec and mir levels for when no map influences them--
#declare shader_Dots_Stroke = finish {
    brilliance 1
    phong 0.1
    phong_size 9.55
    diffuse 0.8, 0
    ambient 1
    emission 0
    conserve_energy
}

//--translation of spec and mir levels for when no map influences them--
#declare shader_Material = finish {
    brilliance 1
    phong 0.1
    phong_size 9.55
    diffuse 0.8, 0
    ambient 1
    emission 0
    conserve_energy
}


//--Mesh objects--

#declare DATACube =
mesh2 {
    vertex_vectors {
        8, <1.000000, 1.000000, 1.000000>, <1.000000, 1.000000, -1.000000>, <1.000000, -1.000000, 1.000000>, <1.000000, -1.000000, -1.000000>, <-1.000000, 1.000000, 1.000000>, <-1.000000, 1.000000, -1.000000>, <-1.000000, -1.000000, 1.000000>, <-1.000000, -1.000000, -1.000000>
    }
    normal_vectors {
        6, <0.000000, 0.000000, 1.000000>, <0.000000, -1.000000, 0.000000>, <-1.000000, -0.000000, -0.000000>, <0.000000, 0.000000, -1.000000>, <1.000000, -0.000000, 0.000000>, <0.000000, 1.000000, 0.000000>
    }
    uv_vectors {
        14, <0.625000, 0.500000>, <0.875000, 0.500000>, <0.875000, 0.750000>, <0.625000, 0.750000>, <0.375000, 0.750000>, <0.625000, 1.000000>, <0.375000, 1.000000>, <0.375000, 0.000000>, <0.625000, 0.000000>, <0.625000, 0.250000>, <0.375000, 0.250000>, <0.125000, 0.500000>, <0.375000, 0.500000>, <0.125000, 0.750000>
    }
    
    
#declare MAT_Material = 
texture{
        pigment {rgbft<0.8, 0.8, 0.8, 0, 0>}
        finish {shader_Material}
    }
    texture_list {
        1 texture{}
    }
    face_indices {
        12, <0,4,6>, 0,0,0, <0,6,2>, 0,0,0, <3,2,6>, 0,0,0, <3,6,7>, 0,0,0, <7,6,4>, 0,0,0, <7,4,5>, 0,0,0, <5,1,3>, 0,0,0, <5,3,7>, 0,0,0, <1,0,2>, 0,0,0, <1,2,3>, 0,0,0, <5,4,0>, 0,0,0, <5,0,1>, 0,0,0
    }
    normal_indices {
        12, <0,0,0>, <0,0,0>, <1,1,1>, <1,1,1>, <2,2,2>, <2,2,2>, <3,3,3>, <3,3,3>, <4,4,4>, <4,4,4>, <5,5,5>, <5,5,5>
    }
    uv_indices {
        12, <0,1,2>, <0,2,3>, <4,3,5>, <4,5,6>, <7,8,9>, <7,9,10>, <11,12,4>, <11,4,13>, <12,0,3>, <12,3,4>, <10,9,0>, <10,0,12>
    }
    interior {
        ior 1.300000
        caustics 0.15
    }
    radiosity { 
        importance 0.5 
    }
}

//----Blender Object Name: Cube----
object { 
    DATACube
    matrix <1.000000, 0.000000, 0.000000, 0.000000, -0.000000, -1.000000, 0.000000, 1.000000, -0.000000, 0.000000, 0.000000, 0.000000>

}
