/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Names: interned words, scopes and bindings, arrays (manual 3.3.1.9, 3.3.2.2).
 */
#include <config.h>

#include "read/pov/internal.h"

#include <stdlib.h>
#include <string.h>

#define PURPOSE "reading"

static uint32_t hash_text(const char *text, size_t length)
{
	uint32_t h = 2166136261u; /* FNV-1a */

	for (size_t i = 0; i < length; i++)
		h = (h ^ (unsigned char)text[i]) * 16777619u;
	return h;
}

static bool grow_hash(struct pov *p)
{
	uint32_t size = p->hash_size ? 2 * p->hash_size : 2048;
	struct atom **hash = mem_zalloc(p->book, PURPOSE, size * sizeof(*hash)), *next;

	if (!hash)
		return pov_no_memory(p);
	for (uint32_t i = 0; i < p->hash_size; i++) {
		for (struct atom *a = p->hash[i]; a; a = next) {
			next = a->next;
			a->next = hash[a->hash & (size - 1)];
			hash[a->hash & (size - 1)] = a;
		}
	}
	mem_free(p->hash);
	p->hash = hash;
	p->hash_size = size;
	return true;
}

struct atom *atom_get(struct pov *p, const char *text, size_t length)
{
	uint32_t h = hash_text(text, length);
	struct atom *a;
	char *copy;

	for (a = p->hash[h & (p->hash_size - 1)]; a; a = a->next) {
		if (a->hash == h && a->length == length && !memcmp(a->text, text, length))
			return a;
	}
	if (p->atom_count >= p->hash_size && !grow_hash(p))
		return NULL;
	a = pov_alloc(p, sizeof(*a));
	copy = a ? pov_alloc(p, length + 1) : NULL;
	if (!copy)
		return NULL;
	memcpy(copy, text, length);
	a->text = copy;
	a->length = (uint32_t)length;
	a->hash = h;
	a->kind = TOK_NEW_IDENT;
	a->next = p->hash[h & (p->hash_size - 1)];
	p->hash[h & (p->hash_size - 1)] = a;
	p->atom_count++;
	return a;
}

bool names_init(struct pov *p)
{
	const struct keyword *k;
	struct atom *a;

	if (!grow_hash(p) || !scope_open(p))
		return false;
	for (k = keyword_table; k < keyword_table + keyword_count; k++) {
		a = atom_get(p, k->text, strlen(k->text));
		if (!a)
			return false;
		a->kind = k->kind;
		a->class = k->class;
		a->directive = k->directive;
	}
	return true;
}

bool scope_open(struct pov *p)
{
	if (!buf_reserve(&p->scopes, p->book, PURPOSE, 1))
		return pov_no_memory(p);
	BUF_AT(&p->scopes, struct scope, p->scopes.count++)->first = NULL;
	return true;
}

uint32_t scope_depth(const struct pov *p)
{
	return p->scopes.count - 1;
}

static void array_free(struct pov *p, struct array *a)
{
	for (uint64_t i = 0; i < a->count; i++) {
		if (a->slot[i].kind == SLOT_ARRAY)
			array_free(p, a->slot[i].u.array);
	}
	p->memory -= sizeof(*a) + a->count * sizeof(a->slot[0]);
	if (a->prev)
		a->prev->next = a->next;
	else
		p->arrays = a->next;
	if (a->next)
		a->next->prev = a->prev;
	mem_free(a);
}

/* What was declared here is gone; nothing that is still alive can refer to it, because references go
 * from deeper scopes outwards only. */
void scope_close(struct pov *p)
{
	struct binding *next;

	for (struct binding *b = BUF_AT(&p->scopes, struct scope, p->scopes.count - 1)->first; b; b = next) {
		next = b->next;
		if (!b->gone)
			b->atom->top = b->below;
		if (b->slot.kind == SLOT_ARRAY)
			array_free(p, b->slot.u.array);
		b->next = p->spare_binding;
		p->spare_binding = b;
	}
	p->scopes.count--;
}

struct binding *bind(struct pov *p, struct atom *atom, uint32_t depth)
{
	struct scope *s = BUF_AT(&p->scopes, struct scope, depth);
	struct binding *b = atom->top;

	if (b && b->depth == depth)
		return b;
	b = p->spare_binding;
	if (b) {
		p->spare_binding = b->next;
		memset(b, 0, sizeof(*b));
	} else {
		b = pov_alloc(p, sizeof(*b));
	}
	if (!b)
		return NULL;
	b->atom = atom;
	b->depth = depth;
	b->below = atom->top;
	b->next = s->first;
	s->first = b;
	atom->top = b;
	return b;
}

void unbind(struct pov *p, struct atom *atom)
{
	struct binding *b = atom->top;
	struct scope *s = BUF_AT(&p->scopes, struct scope, b->depth);

	atom->top = b->below;
	b->gone = true;
	if (!p->macro_depth && s->first == b) { /* no parameter can refer to it */
		s->first = b->next;
		b->next = p->spare_binding;
		p->spare_binding = b;
	}
	pov_charge(p, 4);
}

struct slot *slot_follow(struct slot *s)
{
	while (s->kind == SLOT_REF)
		s = s->u.ref;
	return s;
}

struct array *array_new(struct pov *p, uint32_t dims, const uint32_t *size)
{
	struct array *a;
	uint64_t count = 1;
	size_t bytes;

	for (uint32_t i = 0; i < dims; i++) {
		count *= size[i];
		if (count > p->limit.elements) {
			struct diag_pos pos = source_pos(p);

			pov_limit(p, &pos, "elements", (double)p->limit.elements,
				  "the array has too many elements");
			return NULL;
		}
	}
	bytes = sizeof(*a) + (size_t)count * sizeof(a->slot[0]);
	if (!pov_charge_memory(p, bytes) || !pov_charge(p, 8 + count / 8))
		return NULL;
	a = mem_zalloc(p->book, PURPOSE, bytes);
	if (!a) {
		pov_no_memory(p);
		return NULL;
	}
	a->dims = dims;
	a->count = count;
	memcpy(a->size, size, dims * sizeof(*size));
	a->next = p->arrays;
	if (a->next)
		a->next->prev = a;
	p->arrays = a;
	return a;
}

struct array *array_copy(struct pov *p, const struct array *from)
{
	struct array *a;

	if (!pov_nest(p))
		return NULL;
	a = array_new(p, from->dims, from->size);
	for (uint64_t i = 0; a && i < a->count; i++) {
		if (!slot_copy(p, &a->slot[i], &from->slot[i]))
			a = NULL;
	}
	pov_unnest(p);
	return a;
}

bool slot_copy(struct pov *p, struct slot *to, const struct slot *from)
{
	struct array *a;

	if (from->kind != SLOT_ARRAY) {
		*to = *from;
		return true;
	}
	a = array_copy(p, from->u.array);
	if (!a)
		return false;
	to->kind = SLOT_ARRAY;
	to->u.array = a;
	return true;
}

void arrays_release(struct pov *p)
{
	struct array *next;

	for (struct array *a = p->arrays; a; a = next) {
		next = a->next;
		mem_free(a);
	}
	p->arrays = NULL;
}

static bool predeclare_number(struct pov *p, const char *name, double value)
{
	struct atom *a = atom_get(p, name, strlen(name));
	struct binding *b = a ? bind(p, a, 0) : NULL;

	if (!b)
		return false;
	b->slot.kind = SLOT_NUMBER;
	b->slot.u.number = (struct pov_value){ POV_FLOAT, 1, { value, value, value, value, value } };
	return true;
}

static bool predeclare_string(struct pov *p, const char *name, const char *text, size_t length)
{
	struct atom *a = atom_get(p, name, strlen(name));
	struct binding *b = a ? bind(p, a, 0) : NULL;
	char *copy = b ? pov_alloc(p, length + 1) : NULL;

	if (!copy)
		return false;
	memcpy(copy, text, length);
	b->slot.kind = SLOT_STRING;
	b->slot.u.string = copy;
	return true;
}

/* NAME=VALUE from the command line or an .ini: a number, or a string with its quotes. */
static bool predeclare_option(struct pov *p, const struct read_define *d)
{
	size_t length = strlen(d->value);
	struct atom *a = atom_get(p, d->name, strlen(d->name));
	char *end;
	double value;

	if (!a)
		return false;
	if (a->kind != TOK_NEW_IDENT) {
		pov_fail_at(p, NULL, "%s=%s: %s is a reserved word; choose another name", d->name,
			    d->value, d->name);
		return false;
	}
	if (length >= 2 && d->value[0] == '"' && d->value[length - 1] == '"')
		return predeclare_string(p, d->name, d->value + 1, length - 2);
	value = strtod(d->value, &end);
	if (end == d->value || *end) {
		pov_fail_at(p, NULL, "%s=%s: the value is neither a number nor a string in quotes",
			    d->name, d->value);
		return false;
	}
	return predeclare_number(p, d->name, value);
}

/* What POV-Ray knows before the first line (manual 3.3.1.5.1); without an animation all of that is 0. */
bool predeclare(struct pov *p)
{
	const struct read_options *o = p->options;
	const struct frame_now *f = &o->frame;

	if (!predeclare_number(p, "image_width", o->width ? o->width : READ_WIDTH) ||
	    !predeclare_number(p, "image_height", o->height ? o->height : READ_HEIGHT) ||
	    !predeclare_number(p, "frame_number", f->number) ||
	    !predeclare_number(p, "initial_frame", f->initial) ||
	    !predeclare_number(p, "final_frame", f->final) ||
	    !predeclare_number(p, "initial_clock", f->initial_clock) ||
	    !predeclare_number(p, "final_clock", f->final_clock) ||
	    !predeclare_number(p, "clock_delta", f->clock_delta) ||
	    !predeclare_string(p, "input_file_name", p->source->file, strlen(p->source->file)))
		return false;
	for (uint32_t i = 0; i < o->define_count; i++) {
		if (!predeclare_option(p, &o->defines[i]))
			return false;
	}
	return true;
}
