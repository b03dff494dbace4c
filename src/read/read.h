/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading a scene file. The reader is chosen by the file's first bytes and its name's ending.
 */
#ifndef ALIDADE_READ_READ_H
#define ALIDADE_READ_READ_H

#include <stdbool.h>
#include <stdint.h>

#include "base/diag.h"
#include "read/frames.h"
#include "scene/scene.h"

/* Limits on what a scene may ask of the reader; 0 means the default, see limits.h. */
struct read_limits {
	uint32_t nesting; /* of braces, parentheses and #if, together */
	uint32_t macro_depth;
	uint32_t include_depth;
	uint64_t loop_steps; /* iterations of all #while and #for together */
	uint64_t string_bytes; /* of one string */
	uint64_t tokens; /* read in all, macro bodies and loops again each time */
	uint64_t elements; /* of one list or array */
	uint64_t objects;
	uint64_t texture_pixels; /* of one picture file */
	uint64_t texture_bytes; /* of all picture files together, as they are kept */
	uint64_t memory; /* bytes of declared values and items; meshes have their own limit, the book */
	double seconds; /* of reading; 0: none */
};

/* The picture's size where neither the caller nor an .ini gives one: that of Debian's povray.ini, so that
 * the same command line asks POV-Ray and us for the same picture. */
#define READ_WIDTH 800
#define READ_HEIGHT 600

struct read_define {
	const char *name, *value; /* value is an SDL float or a quoted string */
};

/* What an .ini file asks for; a field is given if its bit in set is. */
enum {
	READ_JOB_WIDTH = 1, READ_JOB_HEIGHT = 2, READ_JOB_OUTPUT = 4, READ_JOB_AA = 8,
	READ_JOB_AA_METHOD = 16, READ_JOB_AA_DEPTH = 32, READ_JOB_AA_THRESHOLD = 64,
	READ_JOB_AA_GAMMA = 128, READ_JOB_START_ROW = 256, READ_JOB_END_ROW = 512,
	READ_JOB_START_COLUMN = 1024, READ_JOB_END_COLUMN = 2048, READ_JOB_ALPHA = 4096
};

struct read_job {
	unsigned set;
	char *output; /* in the scene's arena */
	uint32_t width, height;
	bool aa, alpha;
	uint32_t aa_method, aa_depth;
	double aa_threshold, aa_gamma;
	/* As written: 1-based pixel numbers, or fractions of the picture if below 1 (POV-Ray 3.2.8.3.3). */
	double start_row, end_row, start_column, end_column;
	struct frame_settings frames;
};

struct pool;
struct read_pictures; /* pictures.h */

struct read_options {
	const char *const *include_dirs; /* -L, in order */
	uint32_t include_dir_count;
	bool no_system_includes; /* do not look in an installed POV-Ray's include folder */
	const char *write_dir; /* scenes may write files below it; NULL: none */
	bool lenient; /* what is not supported is a warning, not an error */
	const struct read_define *defines;
	uint32_t define_count;
	uint32_t width, height; /* image_width, image_height; 0: not yet known (the .ini may say) */
	struct frame_now frame; /* all 0: no animation */
	uint32_t frame_digits; /* of the number in the name of a scene that an .ini names by #### */
	struct read_pictures *pictures; /* kept for the next frame; NULL: there is none */
	struct read_stdin *standard_input; /* NULL: nobody will want it again */
	struct read_limits limits;
	struct pool *pool; /* long lists are read by its threads; NULL: by this one */
	bool quiet_debug; /* do not pass on #debug output */
	/* Asked now and then; true: stop with STATUS_SIGINT. May be NULL. */
	bool (*stop)(void *arg);
	void *stop_arg;
};

/* Standard input can be read once only: its text is kept here from frame to frame. */
struct read_stdin {
	char *bytes; /* NULL: not read yet; by mem_alloc */
	size_t size;
};
void read_stdin_release(struct read_stdin *);

/* What an .ini says, without reading the scene that it names; a file that is none says nothing. Text is
 * left out. Reports nothing: read_scene() will. */
void read_job_peek(const char *path, const struct read_options *, struct mem_book *, struct read_job *);
/* Read the scene (or, for an .ini, the job and the scene it names) from path; "-" is standard input.
 * job may be NULL. Problems go to diag; the first error ends reading and its status is returned; the
 * scene can be released whatever happens. */
enum status read_scene(const char *path, const struct read_options *, struct scene *,
		       struct read_job *job, struct diag *);

#endif
