/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Results, one JSON object a line: each run is written as soon as it is measured, so that nothing but the
 * run at hand is lost, whatever ends the program. A line counts for whoever has its key.
 */
#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "accel/load.h"
#include "base/json_write.h"
#include "base/pool.h"
#include "scene/hash.h"
#include "trade.h"

#define FORMAT 1 /* of lines; a part of the key */

uint64_t trade_hash_text(uint64_t h, const char *text)
{
	return hash_bytes(h, text, strlen(text) + 1);
}

uint64_t trade_hash_file(uint64_t h, const char *path)
{
	FILE *in = fopen(path, "rb");
	char piece[16384];
	size_t n;

	if (!in)
		return 0;
	while ((n = fread(piece, 1, sizeof(piece), in)) > 0)
		h = hash_words(h, piece, n);
	if (ferror(in))
		h = 0;
	fclose(in);
	return h;
}

/* Times of another machine, or of another number of threads, are other times. */
static uint64_t hash_machine(void)
{
	uint64_t h = HASH_START;
	uint32_t cores = pool_cores();
	struct utsname u;

	if (!uname(&u)) {
		h = trade_hash_text(h, u.nodename);
		h = trade_hash_text(h, u.machine);
	}
	return HASH(h, cores);
}

/* The plugin's file: who writes one measures it again after each change. */
static uint64_t hash_accel(uint64_t h, const char *spec)
{
	struct accel_choice c = { 0 };
	struct diag silent = { 0 };

	h = trade_hash_text(h, spec);
	if (!accel_load(&c, spec, &silent)) {
		if (c.handle)
			h = trade_hash_file(h, c.path);
		accel_unload(&c);
	}
	return h;
}

uint64_t trade_options_key(const struct trade *t, const char *const *option, const char *accel)
{
	uint64_t h = HASH_START;
	uint32_t format = FORMAT;

	h = HASH(h, format);
	h = trade_hash_text(h, PACKAGE_VERSION);
	h = HASH(h, t->about.hash);
	h = HASH(h, t->about.width);
	h = HASH(h, t->about.height);
	h = HASH(h, t->program_hash);
	h = HASH(h, t->machine_hash);
	for (uint32_t i = 0; i < t->base_count; i++)
		h = trade_hash_text(h, t->base[i]);
	h = trade_hash_text(h, "");
	for (; *option; option++)
		h = trade_hash_text(h, *option);
	return hash_accel(h, accel);
}

uint64_t trade_setting_key(const struct trade *t, const struct trade_setting *s)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1], *accel = t->base_accel;
	uint64_t h;

	trade_options(t, s, option);
	for (uint32_t f = 0; f < t->factors; f++) {
		if (s->level[f] && t->factor[f].level[s->level[f] - 1].accel)
			accel = t->factor[f].level[s->level[f] - 1].accel;
	}
	h = trade_options_key(t, option, accel);
	h = HASH(h, t->reference.hash);
	h = HASH(h, t->space);
	return HASH(h, t->changed);
}

static enum status store_failed(struct trade *t)
{
	return diag_fail(&t->diag, STATUS_FAILED, NULL,
			 "%s: %s; what was measured before is in it, and is taken up the next time",
			 t->results_name, strerror(errno));
}

/* A line that was cut off by a crash must not swallow the next one. */
static bool end_last_line(FILE *f)
{
	if (fseek(f, 0, SEEK_END) || !ftell(f))
		return true;
	if (fseek(f, -1, SEEK_END))
		return false;
	if (getc(f) == '\n')
		return !fseek(f, 0, SEEK_END);
	return !fseek(f, 0, SEEK_END) && putc('\n', f) != EOF && !fflush(f);
}

enum status trade_store_open(struct trade *t)
{
	struct flock lock = { .l_type = F_WRLCK, .l_whence = SEEK_SET };
	int n = snprintf(t->results_name, sizeof(t->results_name), "%s/results.jsonl", t->folder);
	int m = snprintf(t->work, sizeof(t->work), "%s/work.XXXXXX", t->folder);

	if (n < 0 || (size_t)n >= sizeof(t->results_name) || (size_t)m >= sizeof(t->work))
		return diag_fail(&t->diag, STATUS_USAGE, NULL, "the folder's name is too long: %s", t->folder);
	if (mkdir(t->folder, 0777) && errno != EEXIST)
		return diag_fail(&t->diag, STATUS_FAILED, NULL, "%s: %s", t->folder, strerror(errno));
	t->results = fopen(t->results_name, "a+");
	if (!t->results)
		return diag_fail(&t->diag, STATUS_FAILED, NULL, "%s: %s", t->results_name, strerror(errno));
	if (fcntl(fileno(t->results), F_SETLK, &lock) && (errno == EACCES || errno == EAGAIN))
		return diag_fail(&t->diag, STATUS_FAILED, NULL,
				 "%s is in use by another alidade-trade; two at a time would disturb each "
				 "other's times", t->results_name);
	if (t->fresh && ftruncate(fileno(t->results), 0))
		return store_failed(t);
	if (!end_last_line(t->results))
		return store_failed(t);
	if (!mkdtemp(t->work)) {
		t->work[0] = 0;
		return diag_fail(&t->diag, STATUS_FAILED, NULL, "%s: no folder can be made in it: %s", t->folder,
				 strerror(errno));
	}
	t->machine_hash = hash_machine();
	t->program_hash = trade_hash_file(HASH_START, t->program);
	return STATUS_OK;
}

static void begin_line(struct trade *t, struct json_writer *j, const char *kind, uint64_t key)
{
	char text[24];

	jw_init(j, t->results, JW_LINE);
	jw_object(j, NULL);
	jw_string(j, "kind", kind);
	snprintf(text, sizeof(text), "%016" PRIx64, key);
	jw_string(j, "key", text);
}

static enum status end_line(struct trade *t, struct json_writer *j)
{
	jw_end(j);
	return jw_finish(j) ? STATUS_OK : store_failed(t);
}

enum status trade_store_run(struct trade *t, const struct trade_setting *s, const struct trade_run *r)
{
	char picture[24];
	struct json_writer j;

	begin_line(t, &j, "run", s->key);
	jw_string(&j, "setting", s->label);
	jw_uint(&j, "seed", r->seed);
	snprintf(picture, sizeof(picture), "%016" PRIx64, r->picture);
	jw_string(&j, "picture", picture);
	for (int v = 0; v < TRADE_VALUES; v++) {
		if (!isnan(r->value[v]))
			jw_double(&j, trade_column[v].key, r->value[v]);
	}
	return end_line(t, &j);
}

enum status trade_store_failure(struct trade *t, const struct trade_setting *s, double limit)
{
	struct json_writer j;

	begin_line(t, &j, "failure", s->key);
	jw_string(&j, "setting", s->label);
	if (limit > 0)
		jw_double(&j, "limit", limit);
	jw_string(&j, "message", s->failure);
	return end_line(t, &j);
}

enum status trade_store_verify(struct trade *t, const struct trade_setting *s)
{
	struct json_writer j;

	begin_line(t, &j, "verify", s->key);
	jw_string(&j, "setting", s->label);
	jw_double(&j, "checked", s->checked);
	jw_double(&j, "different", s->different);
	return end_line(t, &j);
}

enum status trade_store_reference(struct trade *t)
{
	char hash[24];
	struct json_writer j;

	begin_line(t, &j, "reference", t->reference.key);
	jw_string(&j, "options", t->reference.options);
	snprintf(hash, sizeof(hash), "%016" PRIx64, t->reference.hash);
	jw_string(&j, "picture", hash);
	jw_double(&j, "noise", t->reference.noise);
	jw_uint(&j, "pictures", t->reference.pictures);
	return end_line(t, &j);
}

uint64_t trade_plan_key(const struct trade *t, const char *stage)
{
	uint64_t h = trade_hash_text(HASH_START, stage);

	h = HASH(h, t->clock);
	h = HASH(h, t->error);
	h = HASH(h, t->combinations);
	for (uint32_t i = 0; i < t->settings; i++)
		h = HASH(h, t->setting[i].key);
	return h;
}

enum status trade_store_plan(struct trade *t, const struct trade_planned *p)
{
	struct json_writer j;

	begin_line(t, &j, "plan", p->key);
	jw_string(&j, "name", p->name);
	jw_array(&j, "levels");
	for (uint32_t i = 0; i < p->count; i++) {
		jw_array(&j, NULL);
		for (uint32_t f = 0; f < t->factors; f++)
			jw_uint(&j, NULL, p->level[i][f]);
		jw_end(&j);
	}
	jw_end(&j);
	return end_line(t, &j);
}

static double number_at(const json_t *v, const char *key, double otherwise)
{
	const json_t *n = json_object_get(v, key);

	return json_is_number(n) ? json_number_value(n) : otherwise;
}

static const char *text_at(const json_t *v, const char *key)
{
	const json_t *s = json_object_get(v, key);

	return json_is_string(s) ? json_string_value(s) : "";
}

static uint64_t hex_at(const json_t *v, const char *key)
{
	return strtoull(text_at(v, key), NULL, 16);
}

static void take_run(struct trade *t, struct trade_setting *s, const json_t *v)
{
	struct trade_run *r = &s->run[s->runs];

	if (s->runs == TRADE_RUNS)
		return;
	for (int i = 0; i < TRADE_VALUES; i++)
		r->value[i] = number_at(v, trade_column[i].key, (double)NAN);
	r->picture = hex_at(v, "picture");
	if (isnan(r->value[TRADE_PROCESS]) || isnan(r->value[TRADE_RMSE]))
		return;
	s->runs++;
	t->kept++;
}

static void take_line(struct trade *t, const json_t *v, uint32_t first)
{
	const char *kind = text_at(v, "kind");
	uint64_t key = hex_at(v, "key");

	for (uint32_t i = first; i < t->settings; i++) {
		struct trade_setting *s = &t->setting[i];

		if (s->key != key)
			continue;
		if (!strcmp(kind, "run")) {
			take_run(t, s, v);
		} else if (!strcmp(kind, "verify")) {
			s->checked = number_at(v, "checked", 0);
			s->different = number_at(v, "different", 0);
		} else if (!strcmp(kind, "failure") && number_at(v, "limit", 0) > 0 &&
			   !(t->limit > number_at(v, "limit", 0))) {
			/* Too slow then is too slow now; what failed otherwise may have been mended. */
			s->failure = trade_text(t, "%s", text_at(v, "message"));
		}
		return;
	}
}

struct bad_lines {
	struct diag_pos first;
	char text[JSON_ERROR_TEXT_LENGTH];
	uint32_t count;
};

/* Calls take for each line that is JSON; bad may be NULL. */
static enum status each_line(struct trade *t, void (*take)(struct trade *, const json_t *, uint32_t),
			     uint32_t arg, struct bad_lines *bad)
{
	char *line = NULL;
	size_t room = 0;
	ssize_t n;
	enum status st = STATUS_OK;

	if (fflush(t->results) || fseek(t->results, 0, SEEK_SET))
		return store_failed(t);
	for (uint32_t i = 1; (n = getline(&line, &room, t->results)) > 0; i++) {
		json_error_t fault;
		json_t *v = json_loadb(line, (size_t)n, JSON_DECODE_INT_AS_REAL, &fault);

		if (v)
			take(t, v, arg);
		else if (bad && !bad->count++) {
			bad->first = (struct diag_pos){ t->results_name, i, 0 };
			snprintf(bad->text, sizeof(bad->text), "%s", fault.text);
		}
		json_decref(v);
	}
	if (ferror(t->results))
		st = store_failed(t);
	clearerr(t->results);
	free(line);
	return st;
}

/* A line that is none is no error: a crash leaves half a one, and what it said can be measured again. */
enum status trade_store_load(struct trade *t, uint32_t first)
{
	struct bad_lines bad = { .count = 0 };
	enum status st = each_line(t, take_line, first, &bad);

	if (bad.count && !first)
		diag_report(&t->diag, DIAG_WARNING, &bad.first,
			    "this is no JSON: %s; %s left out, and what is missing then is measured again "
			    "(--fresh begins a new file)", bad.text,
			    bad.count > 1 ? "it and other such lines are" : "the line is");
	return st;
}

static void take_reference(struct trade *t, const json_t *v, uint32_t arg)
{
	struct trade_reference *r = &t->reference;

	(void)arg;
	if (strcmp(text_at(v, "kind"), "reference") != 0 || hex_at(v, "key") != r->key ||
	    hex_at(v, "picture") != r->hash)
		return;
	r->noise = number_at(v, "noise", (double)NAN);
	r->pictures = number_at(v, "pictures", 1) > 1 ? 2 : 1;
	t->reference.options = trade_text(t, "%s", text_at(v, "options"));
}

/* Its picture has to be there as well, and as it was. */
bool trade_store_find_reference(struct trade *t)
{
	t->reference.pictures = 0;
	t->reference.hash = trade_hash_file(HASH_START, t->reference.file);
	return t->reference.hash && !each_line(t, take_reference, 0, NULL) && t->reference.pictures;
}

static void take_plan(struct trade *t, const json_t *v, uint32_t arg)
{
	struct trade_planned *p = t->looking;
	const json_t *list = json_object_get(v, "levels"), *setting, *level;
	size_t i, f;

	(void)arg;
	if (strcmp(text_at(v, "kind"), "plan") != 0 || hex_at(v, "key") != p->key)
		return;
	p->found = true;
	p->count = 0;
	snprintf(p->name, sizeof(p->name), "%s", text_at(v, "name"));
	json_array_foreach(list, i, setting) {
		if (p->count == p->room)
			break;
		memset(p->level[p->count], 0, sizeof(*p->level));
		json_array_foreach(setting, f, level) {
			double n = json_number_value(level);

			if (f < t->factors && n >= 0 && n <= t->factor[f].levels)
				p->level[p->count][f] = (uint16_t)n;
		}
		p->count++;
	}
}

void trade_store_find_plan(struct trade *t, struct trade_planned *p)
{
	p->found = false;
	t->looking = p;
	if (each_line(t, take_plan, 0, NULL))
		p->found = false;
	t->looking = NULL;
}
