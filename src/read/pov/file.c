/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * #fopen, #read, #write, #fclose (manual 3.3.2.8, 3.3.2.9).
 *
 * A scene may read data files that lie where its included files lie, below the folders that are looked in; it
 * may write only into a folder that was named for that (--write), and nowhere above. Values in data files are
 * floats, vectors and strings with commas between them, as measured; a file's identifier is gone when its last
 * value has been read.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILES_MAX 64 /* open for writing at one time */

struct data_file {
	struct data_file *next; /* of all */
	FILE *out; /* NULL: read, closed, or left out */
	bool write, ended;
	const char *name, *path;
	struct place at;
	const char *end;
};

static void close_file(struct pov *p, struct data_file *f, const struct diag_pos *pos)
{
	bool failed;

	if (!f->out)
		return;
	failed = ferror(f->out) != 0;
	failed |= fclose(f->out) != 0;
	f->out = NULL;
	if (failed)
		pov_fail_at(p, pos, "\"%s\" could not be written: %s", f->path, strerror(errno));
}

void files_release(struct pov *p)
{
	for (struct data_file *f = p->files; f; f = f->next)
		close_file(p, f, NULL);
}

/* Below where it is looked for: no path of its own. */
static bool stays_below(const char *name)
{
	if (*name == '/')
		return false;
	for (const char *at = name; at; at = strchr(at, '/')) {
		at += *at == '/';
		if (!strncmp(at, "..", 2) && (at[2] == '/' || !at[2]))
			return false;
	}
	return true;
}

static void open_read(struct pov *p, struct data_file *f, const struct diag_pos *pos)
{
	const struct mapping *m;

	if (!stays_below(f->name)) {
		pov_fail_at(p, pos, "\"%s\": a scene may read files only below its own folder and those of -L",
			    f->name);
		return;
	}
	m = source_map(p, "data file", f->name, pos);
	if (!m)
		return;
	f->path = m->path;
	f->at.at = f->at.line_start = m->base ? m->base : "";
	f->at.line = 1;
	f->end = f->at.at + m->size;
}

static void open_write(struct pov *p, struct data_file *f, const struct diag_pos *pos, bool append)
{
	const char *folder = p->options->write_dir;
	uint32_t count = 0;
	int fd;

	for (struct data_file *i = p->files; i; i = i->next)
		count += i->out != NULL;
	if (count >= FILES_MAX) {
		pov_fail_at(p, pos, "more than %d files are open for writing", FILES_MAX);
		return;
	}
	f->path = source_join(p, folder, f->name);
	if (!f->path)
		return;
	/* Links are not followed: they may lead out of the folder. The old file may be mapped, so it is left as it
	 * is and another takes its name. */
	if (!append)
		unlink(f->path);
	fd = open(f->path, O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (append ? O_APPEND : O_TRUNC),
		  0666);
	f->out = fd >= 0 ? fdopen(fd, append ? "a" : "w") : NULL;
	if (!f->out) {
		pov_fail_at(p, pos, "\"%s\" cannot be written: %s", f->path, strerror(errno));
		if (fd >= 0)
			close(fd);
	}
}

/* May the scene write? If not, an error, or with --lenient a file that swallows all. */
static bool may_write(struct pov *p, const struct data_file *f, const struct diag_pos *pos)
{
	if (!p->options->write_dir) {
		if (p->options->lenient)
			pov_warn(p, pos, "the file \"%s\" is not written; --write=DIR lets the scene write into DIR",
				 f->name);
		else
			pov_fail_at(p, pos, "the scene wants to write the file \"%s\"; --write=DIR lets it write into "
				    "DIR, --lenient goes on without", f->name);
		return false;
	}
	if (stays_below(f->name))
		return true;
	pov_fail_at(p, pos, "\"%s\": a scene may write only below %s", f->name, p->options->write_dir);
	return false;
}

/* NAME "path" read, write or append */
void file_open(struct pov *p, struct diag_pos pos)
{
	struct data_file *f = pov_alloc(p, sizeof(*f));
	struct binding *b;
	struct token name;
	bool append;

	if (!f || !token_raw_name(p))
		return;
	name = p->tok;
	if (!name.atom || name.atom->kind != TOK_NEW_IDENT) {
		pov_fail(p, "expected an identifier for the file, found %s", pov_text(p));
		return;
	}
	p->have = false;
	f->name = pov_path(p);
	append = pov_token(p) == TOK_APPEND;
	if (!f->name)
		return;
	f->write = append || p->tok.kind == TOK_WRITE;
	if (!f->write && p->tok.kind != TOK_READ) {
		pov_fail(p, "expected read, write or append, found %s", pov_text(p));
		return;
	}
	p->have = false; /* nothing behind it may be looked at yet */
	if (!f->write)
		open_read(p, f, &pos);
	else if (may_write(p, f, &pos))
		open_write(p, f, &pos, append);
	f->next = p->files;
	p->files = f;
	b = p->failed ? NULL : name.atom->top ? name.atom->top : bind(p, name.atom, 0);
	if (b)
		*slot_follow(&b->slot) = (struct slot){ .kind = SLOT_FILE, .u.item = f };
}

/* The file that the current token names; name: its token. */
static struct data_file *take_file(struct pov *p, struct token *name)
{
	if (!token_raw_name(p))
		return NULL;
	*name = p->tok;
	if (p->tok.kind != TOK_IDENT || p->tok.value.kind != SLOT_FILE) {
		pov_fail(p, "expected the identifier of an open file, found %s", pov_text(p));
		return NULL;
	}
	p->have = false;
	return p->tok.value.u.item;
}

static void forget(struct pov *p, const struct token *name)
{
	struct binding *b = name->atom->top;

	if (b && slot_follow(&b->slot)->kind == SLOT_FILE) {
		slot_follow(&b->slot)->kind = SLOT_EMPTY;
		unbind(p, name->atom);
	}
}

void file_close(struct pov *p, struct diag_pos pos)
{
	struct token name;
	struct data_file *f = take_file(p, &name);

	if (!f)
		return;
	close_file(p, f, &pos);
	forget(p, &name);
}

static double data_float(struct pov *p)
{
	double sign = 1;

	if (p->tok.kind == TOK_DASH || p->tok.kind == TOK_PLUS) {
		sign = p->tok.kind == TOK_DASH ? -1 : 1;
		lex(p);
	}
	if (p->tok.kind != TOK_NUMBER)
		pov_fail_at(p, &p->tok.pos, "expected a float, a vector or a string in the data file");
	return p->failed ? 0 : sign * p->tok.number;
}

static void data_vector(struct pov *p, struct pov_value *v)
{
	v->count = 0;
	v->kind = POV_VECTOR;
	do {
		lex(p);
		if (v->count == 5) {
			pov_fail_at(p, &p->tok.pos, "the vector has more than 5 components");
			return;
		}
		v->c[v->count++] = data_float(p);
		lex(p);
	} while (!p->failed && p->tok.kind == TOK_COMMA);
	if (p->tok.kind != TOK_RIGHT_ANGLE || v->count < 2)
		pov_fail_at(p, &p->tok.pos, "this is no vector of 2 to 5 numbers with commas between them");
}

/* One value, and the comma behind it. False: the file had ended. */
static bool data_value(struct pov *p, struct data_file *f, struct slot *out)
{
	lex(p);
	if (p->tok.kind == TOK_END) {
		f->ended = true;
		return false;
	}
	*out = (struct slot){ .kind = SLOT_NUMBER, .u.number = { POV_FLOAT, 1, { 0 } } };
	if (p->tok.kind == TOK_STRING) {
		p->have = true;
		out->kind = SLOT_STRING;
		out->u.string = pov_string(p);
	} else if (p->tok.kind == TOK_LEFT_ANGLE) {
		data_vector(p, &out->u.number);
	} else {
		out->u.number.c[0] = data_float(p);
	}
	if (p->failed)
		return false;
	lex(p);
	if (p->tok.kind == TOK_END)
		f->ended = true;
	else if (p->tok.kind != TOK_COMMA)
		pov_fail_at(p, &p->tok.pos, "expected a comma between two values of the data file");
	return !p->failed;
}

/* The file takes the scene's place for the length of a value. */
static bool read_value(struct pov *p, struct data_file *f, struct slot *out)
{
	struct source s = { .below = p->source, .p = f->at, .end = f->end, .file = f->path, .folder = "",
			    .conds = p->conds.count, .depth = p->source->depth };
	struct token tok = p->tok;
	bool good;

	p->source = &s;
	good = pov_charge(p, 4) && data_value(p, f, out);
	p->source = s.below;
	f->at = s.p;
	p->tok = tok;
	p->have = false;
	return good;
}

/* (FILE, A, B, ...): identifiers that need not be declared, or elements of arrays. */
void file_read(struct pov *p)
{
	struct slot value, *to;
	struct data_file *f;
	struct token name, target;

	if (!pov_expect(p, TOK_LEFT_PAREN, "after #read"))
		return;
	f = take_file(p, &name);
	if (f && f->write)
		pov_fail_at(p, &name.pos, "the file is open for writing");
	while (f && !p->failed && pov_accept(p, TOK_COMMA) && token_raw_name(p)) {
		target = p->tok;
		if (!target.atom || target.atom->kind != TOK_NEW_IDENT) {
			pov_fail(p, "expected an identifier to read into, found %s", pov_text(p));
			return;
		}
		p->have = false;
		if (f->ended || !read_value(p, f, &value))
			continue;
		to = declare_target(p, &target, false, 0);
		if (to)
			*to = value;
	}
	if (f && f->ended && !p->failed)
		forget(p, &name);
	pov_expect(p, TOK_RIGHT_PAREN, "after what is read");
}

static void write_number(struct pov *p, struct data_file *f)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };

	expr_number(p, &v, 1);
	if (p->failed || !f->out)
		return;
	if (v.count == 1) {
		fprintf(f->out, "%g", v.c[0]);
		return;
	}
	for (uint32_t i = 0; i < v.count; i++)
		fprintf(f->out, "%s%g", i ? "," : "<", v.c[i]);
	fputs("> ", f->out);
}

/* (FILE, what, ...): strings as they are, numbers with six digits; commas may be left out. */
void file_write(struct pov *p)
{
	struct data_file *f;
	struct token name;
	char *text;

	if (!pov_expect(p, TOK_LEFT_PAREN, "after #write"))
		return;
	f = take_file(p, &name);
	if (f && !f->write)
		pov_fail_at(p, &name.pos, "the file is open for reading");
	while (f && !p->failed && pov_token(p) != TOK_RIGHT_PAREN) {
		if (pov_accept(p, TOK_COMMA))
			continue;
		if ((p->tok.kind >= TOK_SINT16BE && p->tok.kind <= TOK_SINT8) ||
		    (p->tok.kind >= TOK_UINT16BE && p->tok.kind <= TOK_UINT8)) {
			pov_fail(p, "binary data (%s) cannot be written", pov_text(p));
			return;
		}
		if (starts_string(p)) {
			text = pov_string(p);
			if (text && f->out)
				fputs(text, f->out);
		} else {
			write_number(p, f);
		}
	}
	pov_expect(p, TOK_RIGHT_PAREN, "after what is written");
}
