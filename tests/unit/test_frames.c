/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Frames: the clocks are those that POV-Ray 3.7.0.10 printed with str(clock, 0, 14) for the same options.
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "read/frames.h"

static void test_parse(void **state)
{
	static const char *const bad[] = { "",	"x",	"1,",	 ",1",	 "9..3", "1..",	   "1.2",
					   "-1", "1..5:0", "1..5:", "1;2", "1 ",	 "1..2..3", "1000000000" };
	struct frame_span s[FRAME_SPANS];
	char many[512] = "";
	uint32_t n;

	(void)state;
	assert_true(frames_parse("1,3..9,20..100:10", s, &n));
	assert_int_equal(n, 3);
	assert_true(s[0].first == 1 && s[0].last == 1 && s[0].step == 1);
	assert_true(s[1].first == 3 && s[1].last == 9 && s[1].step == 1);
	assert_true(s[2].first == 20 && s[2].last == 100 && s[2].step == 10);
	assert_true(frames_parse("0", s, &n) && s[0].first == 0);
	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++)
		assert_false(frames_parse(bad[i], s, &n));
	for (unsigned i = 0; i < FRAME_SPANS; i++)
		strcat(many, i ? ",1" : "1");
	assert_true(frames_parse(many, s, &n));
	strcat(many, ",1");
	assert_false(frames_parse(many, s, &n));
}

static void expect(const struct frame_settings *s, const char *numbers, const char *now)
{
	struct frame_plan p;
	struct frame_now f;
	char text[256] = "";

	frames_plan(&p, s, NULL, 0);
	assert_true(p.animated);
	for (uint64_t i = 0; i < frames_count(&p); i++)
		sprintf(text + strlen(text), "%s%u", i ? " " : "", frames_number(&p, i));
	assert_string_equal(text, numbers);
	frames_now(&p, frames_number(&p, 0), &f);
	sprintf(text, "%.14f %d %u %u %u %g %g %g, %u digits", f.clock, f.clock_on, f.number, f.initial,
		f.final, f.initial_clock, f.final_clock, f.clock_delta, p.digits);
	assert_string_equal(text, now);
}

static void test_as_povray(void **state)
{
	(void)state;
	/* +KFF12 +SF9 +EF11 */
	expect(&(struct frame_settings){ .set = FRAMES_INITIAL | FRAMES_FINAL | FRAMES_SUBSET_START |
						FRAMES_SUBSET_END,
					 .initial_frame = 1, .final_frame = 12, .subset_start = 9,
					 .subset_end = 11 },
	       "9 10 11", "0.72727274894714 1 9 1 12 0 1 0.0909091, 2 digits");
	/* +KFI0 +KFF3 +KI0 +KF2 +KC */
	expect(&(struct frame_settings){ .set = FRAMES_INITIAL | FRAMES_FINAL | FRAMES_FINAL_CLOCK,
					 .final_frame = 3, .final_clock = 2, .cyclic = true },
	       "0 1 2 3", "0.00000000000000 1 0 0 4 0 2 0.5, 1 digits");
	/* +KFI2 +KFF11 +SF0.5 +EF0.9 +KC */
	expect(&(struct frame_settings){ .set = FRAMES_INITIAL | FRAMES_FINAL | FRAMES_SUBSET_START |
						FRAMES_SUBSET_END,
					 .initial_frame = 2, .final_frame = 11, .subset_start = 0.5,
					 .subset_end = 0.9, .cyclic = true },
	       "5 6 7 8 9", "0.30000001192093 1 5 2 12 0 1 0.1, 2 digits");
	/* +KFF8 +KI0.1 +KF0.9 +SF6 +EF6 */
	expect(&(struct frame_settings){ .set = FRAMES_FINAL | FRAMES_INITIAL_CLOCK | FRAMES_FINAL_CLOCK |
						FRAMES_SUBSET_START | FRAMES_SUBSET_END,
					 .final_frame = 8, .initial_clock = 0.1, .final_clock = 0.9,
					 .subset_start = 6, .subset_end = 6 },
	       "6", "0.67142856121063 1 6 1 8 0.1 0.9 0.114286, 1 digits");
	/* +KFF10 +SF9 +EF12: beyond the end; +SF4 +EF2; +KFI-2 became 0 in the .ini */
	expect(&(struct frame_settings){ .set = FRAMES_FINAL | FRAMES_SUBSET_START | FRAMES_SUBSET_END,
					 .final_frame = 10, .subset_start = 9, .subset_end = 12 },
	       "9 10 11 12", "0.88888889551163 1 9 1 10 0 1 0.111111, 2 digits");
	expect(&(struct frame_settings){ .set = FRAMES_FINAL | FRAMES_SUBSET_START | FRAMES_SUBSET_END,
					 .final_frame = 10, .subset_start = 4, .subset_end = 2 },
	       "4", "0.33333334326744 1 4 1 10 0 1 0.111111, 2 digits");
	/* One frame: POV-Ray's clock is NaN, ours the initial one. */
	expect(&(struct frame_settings){ .set = FRAMES_INITIAL, .initial_frame = 3 }, "3",
	       "0.00000000000000 1 3 3 3 0 1 0, 1 digits");
	expect(&(struct frame_settings){ .set = FRAMES_FINAL | FRAMES_STEP, .final_frame = 5, .step = 2 },
	       "1 3 5", "0.00000000000000 1 1 1 5 0 1 0.25, 1 digits");
}

static void test_lists(void **state)
{
	const struct frame_settings none = { .set = 0 },
				    range = { .set = FRAMES_INITIAL | FRAMES_FINAL, .initial_frame = 1,
					      .final_frame = 100 };
	struct frame_span s[FRAME_SPANS];
	struct frame_plan p;
	struct frame_now f;
	uint32_t n;

	(void)state;
	frames_plan(&p, &none, NULL, 0);
	assert_true(!p.animated && frames_count(&p) == 1);
	frames_now(&p, 0, &f);
	assert_true(!f.clock_on && f.clock == 0 && f.number == 0);
	frames_plan(&p, &(struct frame_settings){ .set = FRAMES_CLOCK, .clock = 0.5 }, NULL, 0);
	frames_now(&p, 0, &f);
	assert_true(!p.animated && f.clock_on && f.clock == 0.5 && f.number == 0);

	assert_true(frames_parse("3,5..9:4", s, &n));
	frames_plan(&p, &none, s, n);
	assert_true(p.animated && p.guessed && p.initial == 3 && p.final == 9 && p.digits == 1);
	assert_true(frames_count(&p) == 3 && frames_number(&p, 2) == 9);
	frames_plan(&p, &range, s, n);
	assert_true(!p.guessed && p.initial == 1 && p.final == 100 && p.digits == 3);
	frames_now(&p, 5, &f);
	assert_true(f.clock == (double)(float)(4 / 99.0));
}

static void test_names(void **state)
{
	char out[32];

	(void)state;
	assert_true(frames_name(out, sizeof(out), "a.png", 7, 3, true));
	assert_string_equal(out, "a007.png");
	assert_true(frames_name(out, sizeof(out), "d.d/a", 7, 1, true));
	assert_string_equal(out, "d.d/a7");
	assert_true(frames_name(out, sizeof(out), "x#/a_####_b.png", 12, 1, true));
	assert_string_equal(out, "x#/a_0012_b.png");
	assert_true(frames_name(out, sizeof(out), "a##.png", 1234, 1, true));
	assert_string_equal(out, "a1234.png");
	assert_true(frames_name(out, sizeof(out), "a.pov", 3, 4, false));
	assert_string_equal(out, "a.pov");
	assert_true(frames_name(out, sizeof(out), ".a", 3, 1, true));
	assert_string_equal(out, ".a3");
	assert_false(frames_name(out, 8, "aaaaaaa.png", 3, 1, true));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_parse),
		cmocka_unit_test(test_as_povray),
		cmocka_unit_test(test_lists),
		cmocka_unit_test(test_names),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
