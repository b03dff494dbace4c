/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How surfaces look, as trees: textures of layers, layers of pigment, normal and finish, and the
 * patterns that vary them over space (POV-Ray's manual 3.4.6, 3.4.7).
 *
 * Trees are plain structs joined by pointers, made once and then never changed; those of a scene are in
 * its arena, and those of a reader in its own until scene_adopt_texture() copies what is used.
 */
#ifndef ALIDADE_SCENE_TEXTURE_H
#define ALIDADE_SCENE_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/colour.h"
#include "base/diag.h"
#include "base/vec.h"

struct mem_book;
struct function; /* a compiled user function */

/* What a point is led through before a pattern is asked, one after the other. */
enum warp_kind {
	WARP_TRANSFORM,
	WARP_TURBULENCE,
	WARP_REPEAT,
	WARP_BLACK_HOLE,
	WARP_PLANAR,
	WARP_CYLINDRICAL,
	WARP_SPHERICAL,
	WARP_TOROIDAL,
	WARP_CUBIC
};

struct warp {
	enum warp_kind kind;
	union {
		struct xform place; /* pattern to outside; points go through its inverse */
		struct {
			vec amount;
			uint32_t octaves;
			double lambda, omega;
		} turbulence;
		struct {
			uint32_t axis;
			double width;
			vec offset, flip; /* flip: 1 or -1 a component */
		} repeat;
		struct {
			vec centre;
			double radius, power, strength;
			bool inverse, repeats, uncertain;
			bool none; /* of a type that does nothing */
			vec repeat, uncertainty;
		} hole;
		struct {
			vec orientation; /* unit */
			double exponent; /* dist_exp */
			double distance; /* planar */
			double major; /* toroidal */
		} map; /* planar and its kin */
	} w;
};

enum pattern_kind {
	/* the value is the number of a map's entry, a block */
	PATTERN_CHECKER,
	PATTERN_BRICK,
	PATTERN_HEXAGON,
	PATTERN_SQUARE,
	PATTERN_TRIANGULAR,
	PATTERN_CUBIC,
	PATTERN_OBJECT,
	/* all entries, by their weights */
	PATTERN_AVERAGE,
	/* an image's own colours, entries (material_map) or slopes (bump_map) */
	PATTERN_IMAGE_MAP,
	PATTERN_MATERIAL_MAP,
	PATTERN_BUMP_MAP,
	/* from here on: a value, as a rule of 0 to 1, that a map is looked up with */
	PATTERN_GRADIENT,
	PATTERN_AGATE,
	PATTERN_AOI,
	PATTERN_BOXED,
	PATTERN_BOZO,
	PATTERN_BUMPS,
	PATTERN_CELLS,
	PATTERN_CRACKLE,
	PATTERN_CYLINDRICAL,
	PATTERN_DENSITY_FILE,
	PATTERN_DENTS,
	PATTERN_FACETS,
	PATTERN_FRACTAL,
	PATTERN_FUNCTION,
	PATTERN_GRANITE,
	PATTERN_IMAGE,
	PATTERN_LEOPARD,
	PATTERN_MARBLE,
	PATTERN_ONION,
	PATTERN_PAVEMENT,
	PATTERN_PIGMENT,
	PATTERN_PLANAR,
	PATTERN_QUILTED,
	PATTERN_RADIAL,
	PATTERN_RIPPLES,
	PATTERN_SLOPE,
	PATTERN_SPHERICAL,
	PATTERN_SPIRAL1,
	PATTERN_SPIRAL2,
	PATTERN_SPOTTED,
	PATTERN_TILING,
	PATTERN_WAVES,
	PATTERN_WOOD,
	PATTERN_WRINKLES,
	PATTERN_KINDS
};
#define PATTERN_FIRST_VALUE PATTERN_GRADIENT

/* What becomes of a value: manual 3.4.7.5.6. */
enum wave_kind { WAVE_RAMP, WAVE_SINE, WAVE_TRIANGLE, WAVE_SCALLOP, WAVE_CUBIC, WAVE_POLY };

/* A picture file's samples, loaded once however often it is used; in the scene's arena. */
enum picture_depth { PICTURE_8, PICTURE_16, PICTURE_FLOAT };
struct picture {
	const char *path; /* as found */
	uint32_t width, height, channels; /* 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA */
	enum picture_depth depth;
	void *sample; /* by mem_alloc; [height * width * channels], top row first */
	uint32_t palette_count; /* 0: none; else samples (8 bits, 1 channel) are its numbers */
	uint64_t hash; /* of the samples */
	bool clear; /* alpha is somewhere below 1 */
	bool kept; /* the samples are somebody else's */
	struct diag_pos pos; /* of the first statement that uses it */
};

/* What a pattern takes as its value, and a bump_map as its height. */
enum picture_use { PICTURE_COLOUR, PICTURE_INDEX, PICTURE_ALPHA };
enum picture_map { /* map_type, by POV-Ray's numbers */
	PICTURE_PLANAR = 0,
	PICTURE_SPHERICAL = 1,
	PICTURE_CYLINDRICAL = 2,
	PICTURE_TOROIDAL = 5
};
enum picture_interpolation { /* interpolate, by POV-Ray's numbers */
	PICTURE_NEAREST = 0,
	PICTURE_BILINEAR = 2,
	PICTURE_BICUBIC = 3,
	PICTURE_DISTANCE = 4
};

/* Means of a picture's pixels, in the scene's working space; there are none unless they were asked for. */
#define MIP_LEVELS 31
struct mip_level {
	uint32_t width, height;
	float *texel; /* [height * width * channels], by mem_alloc; straight, with alpha or filter and transmit */
};
struct mip {
	struct mip *next; /* of the scene's */
	struct picture_place *of; /* the picture and how its samples become colours */
	uint32_t channels; /* as the picture's; a palette's have 5 */
	uint32_t count; /* 0: none were made */
	struct mip_level level[MIP_LEVELS]; /* the first is half the picture's size */
};

/* A picture laid on things: which, and how. */
struct picture_place {
	const struct picture *picture;
	enum picture_map map_type;
	enum picture_interpolation interpolate;
	enum picture_use use;
	bool once;
	bool premultiplied; /* colours are multiplied by alpha */
	double repeat_u, repeat_v; /* how often the picture stands where it else would once */
	double offset_u, offset_v; /* in widths and heights */
	double filter_all, transmit_all; /* are added; not for palettes */
	/* From samples to the scene's working space. */
	const float *decode; /* of 8 and 16 bits: [1 << bits] */
	double gamma; /* of floats: colour ^ gamma; 0: first along the sRGB curve, then ^ gamma_then */
	double gamma_then;
	const struct rgbft *entry; /* a palette's colours: [palette_count] */
	const struct mip *mip;
	bool clear; /* some of it lets light through */
};

struct pattern {
	enum pattern_kind kind;
	uint32_t id; /* in the scene's list */
	uint32_t warp_count;
	struct warp *warp; /* outermost first: the order in which a point is led through them */
	enum wave_kind wave;
	double frequency, phase, exponent; /* value * frequency + phase, then the wave; 1, 0, 1 */
	uint32_t noise; /* noise_generator: 1, 2 or 3, or 0: the scene's */
	/* The pattern's own turbulence, which comes behind all warps; marble, wood and agate use it inside
	 * (of these only agate warps by it as well). */
	struct {
		vec amount;
		uint32_t octaves;
		double lambda, omega;
	} turbulence;
	bool wants_uv; /* something that it is made of is asked at (u, v, 0) */
	union {
		vec gradient;
		struct {
			vec size;
			double mortar;
		} brick;
		double agate_turb;
		struct {
			vec form;
			double metric, offset;
			bool solid;
		} crackle;
		struct {
			double size, coords, metric; /* facets */
		} facets;
		struct {
			double control0, control1;
		} quilted;
		struct {
			vec slope, altitude; /* unit, or 0: not given */
			double slope_weight; /* altitude has the rest of 1 */
			double slope_low, slope_width, altitude_low, altitude_width; /* width 0: as is */
			bool point_at; /* slope is a place to look at */
		} slope;
		int32_t arms; /* spiral */
		uint32_t tiling;
		struct {
			uint32_t sides, tiles, number, exterior, interior, form;
		} pavement;
		struct {
			uint32_t magnet; /* 0: none, or the type 1 or 2 */
			bool julia;
			uint32_t iterations, exponent, exterior, interior;
			double exterior_factor, interior_factor, re, im;
		} fractal;
		struct picture_place image;
		struct pigment *pigment; /* pigment_pattern: its grey */
		struct function *function;
		uint32_t object; /* PATTERN_OBJECT: a solid of the scene */
	} of;
};

enum map_kind { MAP_NONE, MAP_COLOUR, MAP_PIGMENT, MAP_NORMAL, MAP_TEXTURE, MAP_SLOPE };

/* An entry of a map: at: a value of the pattern, rising; or for an average the entry's weight. */
struct map_entry {
	double at;
	union {
		struct rgbft colour;
		struct pigment *pigment;
		struct normal *normal;
		struct texture *texture;
		struct {
			double height, slope;
		} slope;
	} is;
};

struct map {
	enum map_kind kind;
	uint32_t id; /* in the scene's list */
	bool wants_uv, clear; /* some entry is asked at (u, v, 0); lets light through */
	uint32_t count;
	struct map_entry *entry;
};

struct pigment {
	bool uv; /* all below is asked at (u, v, 0) */
	bool wants_uv; /* it is, or some part of it */
	bool clear; /* light may pass somewhere */
	struct rgbft colour; /* if pattern is NULL */
	struct pattern *pattern;
	struct map map; /* colours or pigments; none: grey by value, or what the pattern itself brings */
};

struct normal {
	bool uv;
	bool wants_uv;
	bool no_bump_scale;
	struct pattern *pattern; /* never NULL */
	double amount; /* bump_size for a bump_map */
	double accuracy; /* how far apart the pattern is sampled for its slope */
	struct map map; /* slopes or normals; none: the pattern's own heights */
};

/* POV-Ray's finish block (manual 3.4.6.3), with the albedo variants already divided out. */
struct finish {
	struct rgb ambient, emission;
	double diffuse, diffuse_back, brilliance;
	double indirect, indirect_back; /* diffuse for indirect light: before albedo raised it */
	double phong, phong_size;
	double specular, roughness; /* roughness > 0 */
	double metallic;
	struct rgb reflection_min, reflection_max;
	double reflection_falloff, reflection_exponent, reflection_metallic;
	double irid, irid_thickness, irid_turbulence; /* thin film; irid > 0 if any */
	double crand; /* noise in diffuse light */
	struct rgb translucency; /* if subsurface: about how far light goes below, in mm; each > 0 */
	bool reflection_fresnel;
	bool conserve_energy;
	bool subsurface; /* light goes below the surface instead of diffuse, if the scene's settings want it */
};

struct layer {
	struct pigment pigment;
	struct normal *normal; /* NULL: smooth */
	struct finish finish;
};

/* Either layers, of which layer[0] is the topmost, the first that a ray from outside meets; or a pattern
 * that chooses and blends textures (texture_map, material_map): then count is 0. */
struct texture {
	uint32_t count;
	struct layer *layer;
	bool uv;
	struct pattern *pattern; /* NULL: layers */
	struct map map;
	bool plain; /* looks the same everywhere: no pattern in it, nor a normal */
	bool wants_uv; /* some part of it is asked at (u, v, 0) */
	bool clear; /* light may pass somewhere */
};

/* The finish that POV-Ray starts from (manual 3.4.6.3). */
struct finish finish_default(void);
/* True if light can pass: filter or transmit may be other than 0 in every layer. Pictures with alpha and
 * patterns count as a whole. */
bool texture_translucent(const struct texture *);
/* Set what the others know about themselves (wants_uv, clear, plain) from what is below, which has been
 * examined before. */
void map_examine(struct map *);
void pigment_examine(struct pigment *);
void normal_examine(struct normal *);
void texture_examine(struct texture *);

/* Deep copies into the scene's arena. What several trees share is copied once, as long as the book of copies
 * is the same. Of copies: 0 at first; released when all is copied. False, NULL: no memory. */
struct scene;
struct copies {
	struct mem_book *book;
	uint32_t count, room;
	struct copy *copy; /* hashed by the original */
};
bool scene_adopt_texture(struct scene *, struct copies *, const struct texture *from, struct texture *to);
struct pigment *scene_adopt_pigment(struct scene *, struct copies *, const struct pigment *);
bool scene_adopt_normal(struct scene *, struct copies *, struct normal **);
bool scene_adopt_pattern(struct scene *, struct copies *, struct pattern **);
struct function *scene_adopt_function(struct scene *, struct copies *, const struct function *);
/* For those above: a flat copy of what follows, remembered; *new: it was made now. */
void *copies_take(struct scene *, struct copies *, const void *from, size_t bytes, bool *new);
void copies_release(struct copies *);

#endif
