// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare Trace_level = 12;
#include "stage.inc"
sphere { <-1.2, 1, 0>, 0.9 pigment { rgbf 1 } interior { ior 1.2 fade_distance 0.8 fade_power 2 fade_color <0.9, 0.3, 0.1> } }
sphere { <1.2, 1, 0>, 0.9 pigment { rgbf 1 } interior { fade_distance 0.6 fade_power 1001 fade_color <0.1, 0.5, 0.9> } }
