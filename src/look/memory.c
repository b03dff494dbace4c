/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "look/memory.h"

static void line(FILE *out, const char *label, bool predicted, uint64_t before, uint64_t then)
{
	fprintf(out, "  %-26s ", label);
	if (predicted)
		fprintf(out, "%15.2f", (double)before / 1048576);
	else
		fprintf(out, "%15s", "unknown");
	fprintf(out, " %15.2f\n", (double)then / 1048576);
}

void memory_building_text(const struct geometry *g, FILE *out)
{
	struct geometry_memory m = { 0 };

	geometry_get_memory(g, &m);
	fprintf(out, "%-28s %15s %15s\n", "building, MiB", "predicted", "taken");
	line(out, "most, with the scene", m.predicted, m.predicted_most, m.most);
	line(out, "kept, with the scene", m.predicted, m.predicted_kept, m.kept);
}

static void number(struct json_writer *j, const char *key, bool known, uint64_t value)
{
	if (known)
		jw_uint(j, key, value);
	else
		jw_null(j, key);
}

void memory_building_json(struct json_writer *j, const struct geometry *g)
{
	struct geometry_memory m = { 0 };

	geometry_get_memory(g, &m);
	jw_object(j, "building");
	number(j, "predicted_most", m.predicted, m.predicted_most);
	number(j, "predicted_kept", m.predicted, m.predicted_kept);
	jw_uint(j, "most", m.most);
	jw_uint(j, "kept", m.kept);
	jw_end(j);
}
