/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Items: what stands at the top level of a scene.
 */
#include <config.h>

#include "read/pov/parser.h"

static bool skip_item(struct pov *p, const char *name)
{
	struct diag_pos pos = pov_pos(p);

	pov_next(p);
	if (pov_unsupported(p, &pos, name, NULL))
		pov_skip_block(p);
	return true;
}

bool pov_top_item(struct pov *p)
{
	enum pov_token_kind kind = pov_token(p);

	if (pov_ident_kind(p) != ITEM_NONE) {
		pov_next(p);
		return true;
	}
	if (kind < TOK_HASH)
		return false;
	return skip_item(p, keyword_text(kind));
}

void pov_default(struct pov *p)
{
	while (pov_token(p) != TOK_RIGHT_BRACE && pov_token(p) != TOK_END) {
		pov_next(p);
		pov_skip_block(p);
	}
}

void *pov_read_item(struct pov *p, enum pov_item_kind *kind)
{
	static char none;

	*kind = ITEM_OTHER;
	pov_next(p);
	pov_skip_block(p);
	return &none;
}
