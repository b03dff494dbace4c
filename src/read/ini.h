/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray's .ini files, as far as Blender's add-on writes them (manual 3.2.5.2).
 */
#ifndef ALIDADE_READ_INI_H
#define ALIDADE_READ_INI_H

#include <stddef.h>

#include "read/read.h"

struct ini {
	struct read_job *job;
	const char *input; /* the scene, relative to where we are; never NULL after success */
	const struct read_define *define; /* the options' and its own; in the scene's arena */
	uint32_t define_count;
	const char *const *folder; /* the options' include_dirs and its own Library_Path */
	uint32_t folder_count;
};

/* Do these bytes look like an .ini file rather than a scene? */
bool ini_recognise(const char *bytes, size_t size);
enum status ini_read(struct ini *, const char *path, const char *bytes, size_t size,
		     const struct read_options *, struct scene *, struct diag *);

#endif
