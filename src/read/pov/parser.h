/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The inner contract of the POV-Ray scene description language reader.
 *
 * lex.c makes tokens of bytes; direct.c, cond.c and macro.c carry out directives and macros between
 * them, at any token position, so that whoever asks for the next token never sees one (the next token
 * is fetched by pov_token(), not by pov_next()); expr.c evaluates; items (camera.c,
 * light.c, texture.c, object.c, mesh.c, settings.c) read blocks and write the scene. Chapters are
 * those of POV-Ray 3.7's manual.
 *
 * Errors: the first one is reported and remembered, and from then on pov_token() returns TOK_END, so
 * that every loop of the reader ends; callers test p->failed only before they would store something.
 */
#ifndef ALIDADE_READ_POV_PARSER_H
#define ALIDADE_READ_POV_PARSER_H

#include "base/diag.h"
#include "read/pov/keywords.h" /* enum pov_token_kind: TOK_..., one for each reserved word, from one table */
#include "read/read.h"
#include "scene/scene.h"

struct pov; /* the parser; its fields are in internal.h, for the files of the core only */

/* A scalar, vector or colour: expressions promote as the manual's 3.3.1.4 says. */
struct pov_value {
	enum { POV_FLOAT, POV_VECTOR, POV_COLOUR } kind;
	uint32_t count; /* 1, or the number of components: 2..5; a colour has 5 */
	double c[5]; /* colour: red, green, blue, filter, transmit */
};

/* Tokens. The current one is looked at with pov_token() and passed with pov_next(). An identifier that
 * was declared arrives as TOK_IDENT with its value behind pov_ident(); one not declared, as
 * TOK_NEW_IDENT. Keywords that are shadowed by nothing arrive as themselves. */
enum pov_token_kind pov_token(struct pov *);
void pov_next(struct pov *);
bool pov_accept(struct pov *, enum pov_token_kind); /* pass it if it is the current one */
bool pov_expect(struct pov *, enum pov_token_kind, const char *context); /* or report an error */
struct diag_pos pov_pos(const struct pov *); /* of the current token */
const char *pov_text(struct pov *); /* of the current token, for messages */

/* Errors. pov_fail: what was wrong, in a clause; the place is the current token's. */
void pov_fail(struct pov *, const char *fmt, ...) DIAG_PRINTF(2, 3);
void pov_fail_at(struct pov *, const struct diag_pos *, const char *fmt, ...) DIAG_PRINTF(3, 4);
void pov_warn(struct pov *, const struct diag_pos *, const char *fmt, ...) DIAG_PRINTF(3, 4);
/* What the scene uses and we cannot render: an error that names it, or with --lenient a warning (once
 * a construct and place). Returns true if reading goes on. */
bool pov_unsupported(struct pov *, const struct diag_pos *, const char *construct, const char *remedy);
bool pov_failed(const struct pov *);
bool pov_no_memory(struct pov *); /* reports; returns false */
/* Something an item has that we cannot render. It is no error to declare that, so the item carries the
 * first such thing, and whoever puts the item into the scene passes it to pov_lack_use(). */
struct pov_lack {
	const char *construct; /* NULL: nothing is lacking */
	const char *remedy; /* may be NULL */
	struct diag_pos pos; /* where the construct is written */
};
void pov_lack_note(struct pov *, struct pov_lack *, const char *construct, const char *remedy);
void pov_lack_add(struct pov_lack *to, const struct pov_lack *from); /* keeps the first */
bool pov_lack_use(struct pov *, const struct pov_lack *); /* pov_unsupported(), if there is one */
/* Skip a balanced { ... } whose { is the current token, evaluating nothing but directives. */
void pov_skip_block(struct pov *);
/* Limits: count one more brace, list element, object ...; false: the limit was reached and reported. */
bool pov_nest(struct pov *);
void pov_unnest(struct pov *);

/* Expressions (3.3.1). Each reports an error if there is none here. pov_comma: pass one if it is there. */
double pov_float(struct pov *);
double pov_float_full(struct pov *); /* with comparisons, && and ||: conditions */
vec pov_vector(struct pov *); /* a float is promoted to <f,f,f> */
void pov_vector2(struct pov *, double *u, double *v);
struct pov_value pov_value(struct pov *); /* any numeric expression */
struct rgbft pov_colour(struct pov *); /* colour, color, rgb*, srgb*, identifier, or a vector */
char *pov_string(struct pov *); /* in the parser's arena; literals with their escapes resolved */
char *pov_path(struct pov *); /* the same for a file name: a backslash stays one */
bool pov_bool(struct pov *, bool if_absent); /* optional on/off after a flag keyword */
uint32_t pov_count(struct pov *, const char *what, uint32_t min, uint64_t max);
void pov_comma(struct pov *);
bool pov_starts_number(struct pov *); /* could the current token begin a numeric expression? */
bool pov_starts_vector(struct pov *); /* and can that only be a vector? (F + 1 with a vector F) */

/* Transforms (3.3.1.12.4): true if the current token begins one (translate, rotate, scale, matrix,
 * transform), which is then applied after *x. */
bool pov_transform(struct pov *, struct xform *x);

/* Declared things other than numbers and strings hang on identifiers as items. Copying is by value;
 * an item that owns more than the parser's arena says how in items.h. */
enum pov_item_kind {
	ITEM_NONE, ITEM_CAMERA, ITEM_LIGHT, ITEM_PIGMENT, ITEM_NORMAL, ITEM_FINISH, ITEM_TEXTURE,
	ITEM_INTERIOR, ITEM_MATERIAL, ITEM_OBJECT, ITEM_TRANSFORM, ITEM_DENSITY, ITEM_MEDIA,
	ITEM_FOG, ITEM_RAINBOW, ITEM_SKY_SPHERE, ITEM_COLOUR_MAP, ITEM_PIGMENT_MAP,
	ITEM_NORMAL_MAP, ITEM_TEXTURE_MAP, ITEM_SLOPE_MAP, ITEM_DENSITY_MAP, ITEM_FUNCTION,
	ITEM_SPLINE, ITEM_OTHER
};
enum pov_item_kind pov_ident_kind(struct pov *); /* of a TOK_IDENT; ITEM_NONE: number, string, array.. */
void *pov_ident_item(struct pov *); /* the item itself, read-only */
/* Called by #declare and #local for a right side that is no number, string, array, spline or function:
 * reads it and returns the item (NULL after an error), with its kind. In items.c. */
void *pov_read_item(struct pov *, enum pov_item_kind *kind);

/* A file where #include would look; its path in the scene's arena, NULL: not there. */
char *pov_find_file(struct pov *, const char *name);

/* The scene being made, and where small things may be kept until reading ends. */
struct scene *pov_scene(struct pov *);
struct arena *pov_arena(struct pov *);
struct mem_book *pov_book(struct pov *);
const struct read_options *pov_options(const struct pov *);
int pov_version(const struct pov *); /* in force here, 370 for 3.7 */
double pov_gamma(const struct pov *); /* assumed_gamma so far; 0: not given (srgb is an error then) */

/* Raw bytes, for mesh.c: what follows the last token that was passed, to the end of the file or macro
 * body it came from, so that long plain lists of numbers are read without making tokens. False if the
 * next token has already been looked at, or after an error. After reading up to now (not beyond the list:
 * braces are counted by pov_next()) call pov_raw_done(); lines and columns stay right. A # or a name in
 * there is for the tokens' way: stop before it. */
bool pov_raw(struct pov *, const char **begin, const char **end);
void pov_raw_done(struct pov *, const char *now);

/* Items: called at the top level and within objects. In items.c: the block whose keyword is current. */
bool pov_top_item(struct pov *); /* false: not an item; nothing read */
void pov_default(struct pov *); /* the body of #default { ... }, after the {, up to the } */

/* What the items have to remember while a file is read: the parser keeps it for them. pov_read() calls
 * begin first (NULL: no memory, reported) and end last, when the whole file has been read. */
struct pov_state;
struct pov_state *pov_items_begin(struct pov *);
struct pov_state *pov_state(struct pov *);
void pov_items_end(struct pov *);

/* Carry the whole file out: the loop over top-level items. In direct.c. */
enum status pov_read(const char *path, const char *bytes, size_t size, const struct read_options *,
		     struct scene *, struct diag *);

#endif
