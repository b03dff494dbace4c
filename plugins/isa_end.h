/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The end of what isa_begin.h begins; gcc's goes to the end of the file.
 */
#ifdef __clang__
#pragma clang attribute pop
#endif
