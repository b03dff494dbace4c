/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "scene/media.h"

struct media media_default(int version)
{
	bool old = version < 350;

	return (struct media){ .phase = MEDIA_ISOTROPIC,
			       .extinction = 1,
			       .method = old ? 1 : 3,
			       .intervals = old ? 10 : 1,
			       .samples_min = old ? 1 : 10,
			       .samples_max = old ? 1 : 10,
			       .aa_level = 3,
			       .aa_threshold = 0.1,
			       .ratio = 0.9 };
}
