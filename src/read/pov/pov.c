/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The parser as an object: its life, its errors, its limits.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "read/limits.h"

static void fail(struct pov *p, enum status st)
{
	if (!p->failed)
		p->status = st;
	p->failed = true;
	p->have = false;
}

static void vfail_at(struct pov *p, const struct diag_pos *pos, const char *fmt, va_list ap)
{
	if (p->failed)
		return;
	pov_debug_flush(p);
	diag_vreport(p->diag, DIAG_ERROR, pos, fmt, ap);
	fail(p, STATUS_SCENE);
}

void pov_fail(struct pov *p, const char *fmt, ...)
{
	struct diag_pos pos = pov_pos(p);
	va_list ap;

	va_start(ap, fmt);
	vfail_at(p, &pos, fmt, ap);
	va_end(ap);
}

void pov_fail_at(struct pov *p, const struct diag_pos *pos, const char *fmt, ...)
{
	va_list ap;

	va_start(ap, fmt);
	vfail_at(p, pos, fmt, ap);
	va_end(ap);
}

void pov_warn(struct pov *p, const struct diag_pos *pos, const char *fmt, ...)
{
	va_list ap;

	if (p->failed || !pov_charge(p, 100))
		return;
	pov_debug_flush(p);
	va_start(ap, fmt);
	diag_vreport(p->diag, DIAG_WARNING, pos, fmt, ap);
	va_end(ap);
}

bool pov_failed(const struct pov *p)
{
	return p->failed;
}

bool pov_no_memory(struct pov *p)
{
	if (!p->failed)
		diag_no_memory(p->diag, "reading the scene", 0);
	fail(p, STATUS_FAILED);
	return false;
}

void pov_limit(struct pov *p, const struct diag_pos *pos, const char *name, double value,
	       const char *what)
{
	pov_fail_at(p, pos, "%s: the limit is %.0f (raise it with --limit %s=N)", what, value, name);
}

/* Each construct is named once a place: a loop would repeat it endlessly. */
static bool warned_before(struct pov *p, const struct diag_pos *pos, const char *construct)
{
	struct warned *w = p->warned.data;

	for (uint32_t i = 0; i < p->warned.count; i++) {
		if (w[i].line == pos->line && w[i].file == pos->file &&
		    !strcmp(w[i].construct, construct))
			return true;
	}
	if (p->warned.count >= 1000)
		return true;
	if (!buf_reserve(&p->warned, p->book, "reading", 1))
		return false;
	construct = arena_strdup(&p->arena, construct);
	if (construct)
		BUF_AT(&p->warned, struct warned, p->warned.count++)[0] =
			(struct warned){ construct, pos->file, pos->line };
	return false;
}

bool pov_unsupported(struct pov *p, const struct diag_pos *pos, const char *construct,
		     const char *remedy)
{
	if (p->failed)
		return false;
	if (!p->options->lenient) {
		pov_fail_at(p, pos, "%s is not supported yet%s%s; --lenient goes on without it",
			    construct, remedy ? ": " : "", remedy ? remedy : "");
		return false;
	}
	if (!warned_before(p, pos, construct))
		pov_warn(p, pos, "%s is not supported yet and left out", construct);
	return true;
}

void pov_lack_note(struct pov *p, struct pov_lack *l, const char *construct, const char *remedy)
{
	if (!l->construct)
		*l = (struct pov_lack){ construct, remedy, pov_pos(p) };
}

void pov_lack_add(struct pov_lack *to, const struct pov_lack *from)
{
	if (!to->construct)
		*to = *from;
}

bool pov_lack_use(struct pov *p, const struct pov_lack *l)
{
	return !l->construct || pov_unsupported(p, &l->pos, l->construct, l->remedy);
}

static bool check_clock(struct pov *p)
{
	struct diag_pos pos = source_pos(p);

	if (p->options->stop && p->options->stop(p->options->stop_arg)) {
		fail(p, STATUS_SIGINT);
		return false;
	}
	if (p->limit.seconds > 0 && clock_seconds() - p->started > p->limit.seconds) {
		pov_limit(p, &pos, "seconds", p->limit.seconds, "reading the scene takes too long");
		return false;
	}
	return true;
}

bool pov_charge(struct pov *p, uint64_t tokens)
{
	struct diag_pos pos;
	uint64_t before = p->tokens;

	p->tokens += tokens;
	if (p->tokens > p->token_limit) {
		pos = source_pos(p);
		pov_limit(p, &pos, "tokens", (double)p->limit.tokens,
			  "loops and macros make the scene too long");
		return false;
	}
	return before >> 16 == p->tokens >> 16 || check_clock(p);
}

bool pov_charge_memory(struct pov *p, uint64_t bytes)
{
	struct diag_pos pos;

	p->memory += bytes;
	if (bytes <= p->limit.memory && p->memory <= p->limit.memory)
		return true;
	pos = source_pos(p);
	pov_limit(p, &pos, "memory", (double)p->limit.memory,
		  "the scene's declarations need too many bytes");
	return false;
}

void *pov_alloc(struct pov *p, size_t bytes)
{
	void *q;

	if (!pov_charge_memory(p, bytes))
		return NULL;
	q = arena_zalloc(&p->arena, bytes);
	if (!q)
		pov_no_memory(p);
	return q;
}

bool pov_nest(struct pov *p)
{
	struct diag_pos pos;

	if (p->failed)
		return false;
	if (++p->nest <= p->limit.nesting)
		return true;
	pos = pov_pos(p);
	pov_limit(p, &pos, "nesting", p->limit.nesting, "nested too deeply");
	return false;
}

void pov_unnest(struct pov *p)
{
	if (p->nest)
		p->nest--;
}

/* #debug gives pieces of lines; the diag wants whole ones. */
void pov_debug(struct pov *p, const char *text)
{
	size_t length = strlen(text);
	char *line, *newline;

	if (p->options->quiet_debug || !pov_charge(p, 16 + length / 16))
		return;
	if (length > UINT32_MAX / 2 || !buf_reserve(&p->debug, p->book, "reading", (uint32_t)length + 1)) {
		pov_no_memory(p);
		return;
	}
	line = p->debug.data;
	memcpy(line + p->debug.count, text, length + 1);
	p->debug.count += (uint32_t)length;
	while ((newline = strchr(line, '\n'))) {
		*newline = 0;
		diag_report(p->diag, DIAG_DEBUG, NULL, "%s", line);
		line = newline + 1;
	}
	p->debug.count = (uint32_t)strlen(line);
	memmove(p->debug.data, line, p->debug.count + 1);
}

void pov_debug_flush(struct pov *p)
{
	if (!p->debug.count)
		return;
	p->debug.count = 0;
	diag_report(p->diag, DIAG_DEBUG, NULL, "%s", (char *)p->debug.data);
}

struct scene *pov_scene(struct pov *p)
{
	return p->scene;
}

struct arena *pov_arena(struct pov *p)
{
	return &p->arena;
}

struct mem_book *pov_book(struct pov *p)
{
	return p->book;
}

const struct read_options *pov_options(const struct pov *p)
{
	return p->options;
}

struct pov_state *pov_state(struct pov *p)
{
	return p->items;
}

int pov_version(const struct pov *p)
{
	return p->version;
}

double pov_gamma(const struct pov *p)
{
	return p->scene->assumed_gamma;
}

static bool start(struct pov *p, const char *path, const char *bytes, size_t size)
{
	const char *slash = strrchr(path, '/');
	char *folder;

	folder = slash ? arena_memdup(&p->arena, path, (size_t)(slash - path) + 2) : "";
	path = arena_strdup(&p->scene->arena, path);
	if (!folder || !path)
		return pov_no_memory(p);
	if (slash)
		folder[strrchr(path, '/') - path + 1] = 0;
	p->scene_folder = folder;
	p->items = pov_items_begin(p);
	return p->items && names_init(p) && source_push_text(p, path, folder, bytes, size) && predeclare(p);
}

static void finish(struct pov *p)
{
	pov_debug_flush(p);
	p->scene->version = p->version;
	if (p->items)
		pov_items_end(p);
	files_release(p);
	arrays_release(p);
	sources_release(p);
	mem_free(p->hash);
	buf_release(&p->conds);
	buf_release(&p->scopes);
	buf_release(&p->streams);
	buf_release(&p->warned);
	buf_release(&p->debug);
	arena_release(&p->arena);
}

enum status pov_read(const char *path, const char *bytes, size_t size,
		     const struct read_options *options, struct scene *scene, struct diag *diag)
{
	struct pov p = {
		.scene = scene, .diag = diag, .options = options, .book = scene->book,
		.limit = read_limits_fill(&options->limits), .version = 370,
		.conds = { .size = sizeof(struct cond) }, .scopes = { .size = sizeof(struct scope) },
		.streams = { .size = sizeof(uint32_t) }, .warned = { .size = sizeof(struct warned) },
		.debug = { .size = 1 }, .started = clock_seconds()
	};

	arena_init(&p.arena, scene->book, "reading");
	p.token_limit = p.limit.tokens + size;
	if (start(&p, path, bytes, size)) {
		while (pov_token(&p) != TOK_END && pov_charge(&p, 8)) {
			if (pov_accept(&p, TOK_SEMICOLON) || bare_directive(&p) || pov_top_item(&p))
				continue;
			pov_fail(&p, "%s cannot stand here: an object, a light, a camera, settings or "
				 "a directive was expected", pov_text(&p));
		}
	}
	finish(&p);
	return p.status;
}
