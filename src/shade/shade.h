/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Shading as POV-Ray does it, in waves: all hits of a batch, then all their shadow rays, then the rays
 * that mirrors and glass ask for. What is kept between the steps stands in a struct tree.
 */
#ifndef ALIDADE_SHADE_SHADE_H
#define ALIDADE_SHADE_SHADE_H

#include "shade/tree.h"

enum indirect_method {
	INDIRECT_OFF, /* ambient stands for it */
	INDIRECT_EXACT, /* rays are gathered at every hit */
	INDIRECT_CACHE /* at some, and between them light is interpolated */
};

/* How indirect light is found, of scenes that ask for it. */
struct indirect {
	enum indirect_method method;
	uint32_t samples; /* rays gathered for a pixel, about */
	uint32_t replications; /* in so many independent sets, at least 1 */
	const struct cache *cache; /* INDIRECT_CACHE; it is not written while pictures are made */
	bool filling; /* what the cache cannot answer becomes a record */
	double slack; /* of the cache: see cache_init() */
	double reach; /* of a record at most, in pixels */
	double pixel, pixel_angle; /* width of a pixel at the camera, and how it grows with the way */
};

#define SHADE_WORLD_END 2e10 /* how far away POV-Ray takes the sky to be, for fog and media: measured */

/* What all shading of one picture shares; read-only while rendering. */
struct shader {
	const struct scene *scene;
	const struct geometry *geometry;
	bool alpha;
	bool footprints; /* textures are told how much of them a ray covers */
	/* What this scene requires: */
	bool translucent; /* some texture lets light through: interiors are followed */
	bool clear_shadows; /* and shadow rays are filtered */
	bool media; /* something fills solids or the world */
	struct indirect indirect; /* method is INDIRECT_OFF unless the scene asks for radiosity */
	bool fog;
	bool projected; /* some light is projected through something */
	bool one_path; /* each camera ray is one sample of many, and repeats nothing: node.path tells which */
	uint32_t soft_rounds; /* how often jittered lights are asked for, at most */
	bool subsurface; /* light goes below some surfaces */
	uint32_t subsurface_rays; /* from below a hit, to where light comes in */
	bool lifts; /* shadow rays start on the smooth surface that a mesh stands for */
	bool marks; /* rays are told their pixels, for verification */
	bool plain, plain_only; /* shade_plain(), shade_plain_only() */
	bool insides; /* what rays are inside of is followed from the camera on */
	struct open_sky {
		struct rgb colour;
		double transmit;
	} open[2]; /* without a sky sphere: what rays see that leave the scene, by node.clear_sky */
};

/* Rays cast for shading, for the reports. */
struct shade_counts {
	uint64_t shadow_cast, shadow_hit;
	uint64_t subsurface_cast, subsurface_hit; /* from below surfaces */
};

/* indirect counts only if the scene asks for it. */
void shader_init(struct shader *, const struct scene *, const struct geometry *, bool alpha,
		 const struct indirect *);

/* The solids that a camera ray starts in, as a list of tree.inside. */
uint32_t shade_camera_inside(const struct shader *, struct tree *, vec org);

/* Once all of the shader is known: may hits take the short way, pov/plain.c? */
bool shade_plain(const struct shader *);
/* And is there nothing else to be seen, by cameras whose rays are one a place? */
bool shade_plain_only(const struct shader *);

/* Find shader.open. */
void shade_sky_init(struct shader *);
/* A ray that left the scene. */
void shade_sky(const struct shader *, struct node *);
/* The layer of a texture that the short way can take, or NULL; and its own light. */
const struct layer *plain_layer(const struct shader *, const struct texture *);
struct rgb plain_base(const struct shader *, const struct layer *);
/* The short way, if shader.plain: tries a hit of a ray along dir, whose colour is to's; true if it took it. Then the
 * light at all that took it, into the colours in tree.plain. */
bool plain_hit(const struct shader *, struct tree *, uint32_t to, vec dir, const uint32_t pixel[2],
	       const struct surface *, uint32_t prim);
void plain_light(const struct shader *, struct tree *, uint32_t thread, uint32_t hints, struct shade_counts *);
/* A ray that hit, unless it takes the short way: appends a met with its parts, layers and mirrors. */
void shade_hit(const struct shader *, struct tree *, uint32_t node, const ald_ray *, const ald_hit *);
/* Light at all hits met in this wave, shadows traced; the parts' own light is complete then. hints: how the rays lie
 * that hit. */
void shade_light(const struct shader *, struct tree *, uint32_t thread, uint32_t hints, struct shade_counts *);
/* The light from below the hits of this wave, whose mets are gone then, and the nodes that it asks for. */
void shade_subsurface(const struct shader *, struct tree *, uint32_t thread, struct shade_counts *);
/* Media between origin and end of nodes first .. first + n - 1, as veils. */
void shade_media(const struct shader *, struct tree *, uint32_t thread, uint32_t first, uint32_t n,
		 struct shade_counts *);
/* Rainbows and fog on the way of the same, hung before what is there. */
void shade_rainbow(const struct shader *, struct tree *, uint32_t first, uint32_t n);
void shade_fog(const struct shader *, struct tree *, uint32_t first, uint32_t n);
/* The nodes that these hits ask for. */
void shade_spawn(const struct shader *, struct tree *);

/* How far down the tree, and how faintly, a ray is still traced (max_trace_level, adc_bailout). */
bool shade_worth(const struct shader *, uint32_t bounce, uint32_t level, double weight);

/* Gathered rays see fog and media only if the radiosity block wants it. */
static inline bool shade_sees_air(const struct shader *sh, const struct node *n)
{
	return !n->bounce || sh->scene->radiosity.media;
}

/* The share of a pixel below which nothing is followed; the radiosity block has its own. */
static inline double shade_bailout(const struct shader *sh, uint32_t bounce)
{
	return bounce ? sh->scene->radiosity.adc_bailout : sh->scene->adc_bailout;
}

#endif
