/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Picture files in a scene: finding and reading them, and the words that lay them on things.
 */
#ifndef ALIDADE_READ_POV_PICTURE_H
#define ALIDADE_READ_POV_PICTURE_H

#include "image/raw.h"
#include "read/pov/items.h"

/* A file that was read, and what is known of it. */
struct pov_picture {
	struct pov_picture *next;
	struct picture *picture; /* of the scene */
	struct image_raw raw; /* without samples */
};

/* A table that turns samples into the scene's working space. */
struct pov_decode {
	struct pov_decode *next;
	enum picture_depth depth;
	bool coarse;
	double gamma, gamma_then; /* as struct picture_place has them */
	float *table;
};

enum pov_picture_use { PICTURE_OF_COLOUR, PICTURE_OF_DATA };

/* After { of an image_map, bump_map, image_pattern or material_map: the file and all words that say how it
 * lies; what follows is left. bump_size: NULL where the word has no place. False after an error. */
bool pov_picture_read(struct pov *, enum pov_picture_use, struct picture_place *, double *bump_size);
/* The whole block, its keyword being passed: { to }. block: how messages call it. */
bool pov_picture_block(struct pov *, enum pov_picture_use, struct picture_place *, double *bump_size,
		       const char *block);

/* Only the file: a string, after the word for its format, if one is there, has been passed. */
struct pov_picture *pov_picture_file(struct pov *, const char *word);

#endif
