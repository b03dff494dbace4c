/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A mesh while it is read; for mesh.c and mesh2.c.
 */
#ifndef ALIDADE_READ_POV_MESH_H
#define ALIDADE_READ_POV_MESH_H

#include "read/pov/items.h"

/* A growing array of mem_alloc's. */
struct mesh_array {
	void *data;
	size_t count, room; /* of elements */
	size_t size; /* of one element, in bytes */
};

struct mesh_draft {
	struct mesh_array vertex; /* of double[3] */
	struct mesh_array index; /* of uint32_t[3] */
	struct mesh_array normal; /* of float[3] */
	struct mesh_array normal_index; /* of uint32_t[3] */
	struct mesh_array uv; /* of float[2] */
	struct mesh_array uv_index; /* of uint32_t[3] */
	uint32_t smooth_count; /* the first so many faces have normals; see struct mesh */
	/* Texture numbers are kept as short as they allow: none while all faces have the same ones,
	 * then one a face, then three. */
	struct mesh_array texture; /* of uint32_t[1] or [3] */
	uint32_t textures_per_face; /* 0 (nothing stored), 1 or 3 */
	uint32_t common; /* the texture of all faces so far, SCENE_NONE: the object's own */
	bool partial; /* some face has the object's own texture */
	uint32_t list_count;
	struct pov_texture **list;
	bool has_inside;
	vec inside;
	struct diag_pos pos;
};

void mesh_draft_init(struct mesh_draft *);
void mesh_draft_release(struct mesh_draft *);
/* Room for more elements; expect: how many there will probably be in all. */
bool mesh_reserve(struct pov *, struct mesh_array *, size_t more, size_t expect);
/* The texture numbers of the next face; they may be SCENE_NONE, then all three are. */
bool mesh_add_texture(struct pov *, struct mesh_draft *, const uint32_t t[3], size_t expect);
/* Of so many faces more that have none, in a mesh without a list of textures. */
void mesh_add_untextured(struct mesh_draft *, size_t count);
/* Drop triangles without area, put the smooth ones first, give it to the scene and make its object.
 * The draft is empty afterwards. NULL: an error was reported. */
struct pov_object *mesh_draft_finish(struct pov *, struct mesh_draft *);
/* A normal of unit length; one of length 0 becomes <1,0,0> and *zero true, as in POV-Ray. */
void mesh_normal(float out[3], vec n, bool *zero);

#endif
