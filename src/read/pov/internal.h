/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The parser's own state, for the files of the core only: names, scopes, sources, directives.
 *
 * Scoping is POV-Ray's (manual 3.3.2.2): dynamic. Every file and every macro call opens a scope; a name
 * means its newest binding, whoever made it. So each name keeps its bindings as a stack, newest on top,
 * and looking up costs nothing.
 */
#ifndef ALIDADE_READ_POV_INTERNAL_H
#define ALIDADE_READ_POV_INTERNAL_H

#include "base/buf.h"
#include "read/pov/parser.h"

#define POV_EPSILON 1e-10 /* POV-Ray's: differences below it do not count in conditions */
#define POV_ARRAY_DIMS 5
#define POV_MACRO_PARAMS 56
#define POV_STREAMS_MAX 1000000 /* random number streams */

enum slot_kind {
	SLOT_EMPTY, /* array element without a value, or a name passed to a macro before it is declared */
	SLOT_NUMBER, SLOT_STRING, SLOT_ARRAY, SLOT_MACRO, SLOT_ITEM, SLOT_FILE,
	SLOT_REF /* a macro's parameter that stands for the caller's identifier */
};

struct slot {
	enum slot_kind kind;
	enum pov_item_kind item_kind;
	union {
		struct pov_value number;
		char *string;
		struct array *array;
		struct macro *macro;
		void *item;
		struct slot *ref;
	} u;
};

/* All arrays are listed, so that those still there at the end can be freed. */
struct array {
	struct array *prev, *next;
	uint32_t dims;
	uint32_t size[POV_ARRAY_DIMS];
	uint64_t count;
	struct slot slot[];
};

/* An interned word: a reserved one, or a name. */
struct atom {
	struct atom *next; /* in its hash chain */
	struct binding *top;
	const char *text;
	uint32_t hash, length;
	enum pov_token_kind kind; /* TOK_NEW_IDENT: a name */
	enum keyword_class class;
	bool directive;
};

struct binding {
	struct slot slot;
	struct atom *atom;
	struct binding *below; /* the atom's older one */
	struct binding *next; /* in its scope */
	uint32_t depth; /* of its scope; 0: global */
	bool gone; /* #undef-ed, waiting for its scope to end */
};

struct scope {
	struct binding *first;
};

/* A place in some text. */
struct place {
	const char *at, *line_start;
	uint32_t line;
};

struct macro {
	const char *name, *file;
	struct place body;
	const char *end; /* of the body */
	uint32_t count;
	struct atom *param[];
};

/* Where characters come from: a file, or a macro's body (a piece of a file). */
struct source {
	struct source *below;
	struct place p;
	const char *end;
	const char *file; /* as shown in messages */
	const char *folder; /* for #include, with its slash; "" is the current one */
	struct macro *macro; /* NULL: a file */
	uint32_t conds; /* open ones when it began */
	uint32_t depth; /* of its scope */
	bool spent; /* taken off, waiting to be used again */
};

/* A file that was included; a second time it is not opened again. */
struct mapping {
	struct mapping *next;
	const char *name, *from; /* as written, and the folder of the file that asked */
	const char *path, *folder;
	void *base; /* NULL: empty */
	size_t size;
};

enum cond_kind { COND_IF, COND_WHILE, COND_FOR, COND_SWITCH };

struct cond {
	enum cond_kind kind;
	struct source *source;
	struct diag_pos pos;
	struct place loop;
	double value; /* of #switch */
	struct atom *var; /* of #for */
	double end, step;
};

struct token {
	enum pov_token_kind kind;
	struct atom *atom; /* of a word */
	double number;
	const char *begin, *end; /* its bytes; of a string without the quotes */
	struct diag_pos pos;
	struct slot value; /* a TOK_IDENT's, copied: its binding may be gone when it is used */
	struct slot *where; /* where that is kept, or the empty element */
	bool element; /* of an array */
	bool waiting; /* a # or a macro's name, still to be carried out */
};

struct warned {
	const char *construct, *file;
	uint32_t line;
};

struct hold {
	bool on;
	int depth;
	const struct source *source;
};

struct pov {
	struct scene *scene;
	struct diag *diag;
	const struct read_options *options;
	struct read_limits limit; /* with the defaults filled in */
	struct arena arena; /* dies with the parser */
	struct mem_book *book;

	enum status status;
	bool failed;

	/* the current token */
	bool have;
	bool raw_names; /* names arrive as they are: no macro is called, nothing is evaluated */
	struct token tok;
	uint64_t passed; /* tokens passed so far */
	char text[64];
	int depth; /* of braces, parentheses and brackets passed */
	bool hold; /* a declaration is not finished: a directive at hold_depth has to wait, and so has the end of
		      the source that it stands in */
	int hold_depth;
	const struct source *hold_source;

	/* sources and directives */
	struct source *source, *spare_source;
	uint32_t macro_depth, include_depth;
	struct mapping *mappings;
	struct data_file *files;
	const char *scene_folder;
	struct buf conds; /* of struct cond */

	/* names */
	struct atom **hash;
	uint32_t hash_size, atom_count;
	struct buf scopes; /* of struct scope */
	struct binding *spare_binding;
	struct array *arrays;

	/* limits */
	uint32_t nest;
	uint64_t tokens, token_limit, loop_steps, memory;
	double started;

	struct buf streams; /* of uint32_t: rand() */
	struct buf warned; /* of struct warned */
	struct buf debug; /* of char: a line of #debug that is not yet complete */
	int version;
	bool clock_warned;
	struct pov_state *items; /* what items.c remembers */
};

/* pov.c */
bool pov_charge(struct pov *, uint64_t tokens); /* false: too many */
void *pov_alloc(struct pov *, size_t bytes); /* from the arena, cleared; reports */
bool pov_charge_memory(struct pov *, uint64_t bytes);
void pov_limit(struct pov *, const struct diag_pos *, const char *name, double value,
	       const char *what); /* reports that a limit was reached */
void pov_debug(struct pov *, const char *text);
void pov_debug_flush(struct pov *);

/* name.c */
bool names_init(struct pov *);
struct atom *atom_get(struct pov *, const char *text, size_t length); /* NULL: no memory, reported */
bool scope_open(struct pov *);
void scope_close(struct pov *);
uint32_t scope_depth(const struct pov *);
struct binding *bind(struct pov *, struct atom *, uint32_t depth); /* NULL: reported */
void unbind(struct pov *, struct atom *); /* the newest */
struct slot *slot_follow(struct slot *);
struct array *array_new(struct pov *, uint32_t dims, const uint32_t *size);
struct array *array_copy(struct pov *, const struct array *);
bool slot_copy(struct pov *, struct slot *to, const struct slot *from); /* arrays deep */
void arrays_release(struct pov *);
bool predeclare(struct pov *);

/* source.c */
bool source_push_text(struct pov *, const char *file, const char *folder, const char *bytes,
		      size_t size);
bool source_push_macro(struct pov *, struct macro *);
void source_pop(struct pov *);
bool source_include(struct pov *, const char *name, const struct diag_pos *);
bool source_exists(struct pov *, const char *name);
/* The file, found as included ones are; NULL: reported. what: the message calls it that. */
struct mapping *source_map(struct pov *, const char *what, const char *name, const struct diag_pos *);
char *source_join(struct pov *, const char *folder, const char *name); /* in the scene's arena */
void sources_release(struct pov *);

/* lex.c: one raw token; TOK_END at the end of the source (which stays). */
void lex(struct pov *);
void lex_blank(struct pov *); /* skip spaces and comments */
enum pov_token_kind lex_skip(struct pov *, struct diag_pos opened, const char *what);
struct diag_pos source_pos(const struct pov *);

/* token.c */
void token_again(struct pov *); /* a name that was looked at before its declaration was finished */
bool token_raw_name(struct pov *); /* the next token with raw_names on */

/* direct.c, cond.c, macro.c: # has been passed; or the macro's name. */
void directive(struct pov *);
bool bare_directive(struct pov *); /* true: the current token began one, which was carried out */
struct hold hold_begin(struct pov *, const struct source *); /* source: the declaration stands in it */
void hold_end(struct pov *, struct hold before);
/* Where a declared value goes. */
struct slot *declare_target(struct pov *, const struct token *name, bool local, uint32_t depth);
/* file.c */
void file_open(struct pov *, struct diag_pos);
void file_close(struct pov *, struct diag_pos);
void file_read(struct pov *);
void file_write(struct pov *);
void files_release(struct pov *);
void cond_if(struct pov *, enum pov_token_kind, struct diag_pos);
void cond_else(struct pov *, enum pov_token_kind, struct diag_pos);
void cond_loop(struct pov *, enum pov_token_kind, struct diag_pos);
void cond_switch(struct pov *, struct diag_pos);
void cond_case(struct pov *, enum pov_token_kind, struct diag_pos);
void cond_break(struct pov *, struct diag_pos);
void cond_end(struct pov *, struct diag_pos);
bool cond_defined(struct pov *); /* ( identifier ) */
void macro_define(struct pov *, struct diag_pos);
void macro_call(struct pov *, struct macro *, struct diag_pos);
bool right_side(struct pov *, struct slot *out, bool parameter); /* of =, or an argument */
bool array_read(struct pov *, struct slot *out);

/* expr.c */
double paren_full(struct pov *); /* ( full expression ) */
void expr_number(struct pov *, struct pov_value *, uint32_t terms); /* + - * / */
void expr_full(struct pov *, struct pov_value *, uint32_t terms); /* also ? : & | < <= = ... */
double expr_float(struct pov *);
/* func.c: the current token is the function's word. */
double func_float(struct pov *);
void func_vector(struct pov *, struct pov_value *, uint32_t terms);
/* string.c */
char *string_or_null(struct pov *, bool path); /* NULL and nothing read if none begins here */
bool starts_string(struct pov *);
/* rand.c */
double stream_seed(struct pov *, uint32_t);
double stream_rand(struct pov *, double);

static inline bool truth(double v)
{
	return v > POV_EPSILON || v < -POV_EPSILON;
}

#endif
