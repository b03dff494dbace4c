/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * One picture, drawn by a process of its own: what it took is then the kernel's word, wait4(2), and what it
 * says of its phases comes from --progress=json, which unlike --stats counts nothing.
 */
#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "trade.h"

#define ARGS 320
#define PAUSE 0.25 /* seconds between two looks at how much it has taken */
#define PATIENCE 50 /* times its CPU time */

extern char **environ;

struct files {
	char out[TRADE_PATH + 16], err[TRADE_PATH + 16];
};

/* In a group of its own, so that ^C comes to us alone; signals as they were before we took them. */
static int spawn(const struct trade *t, const struct files *f, char **argv, pid_t *pid)
{
	posix_spawn_file_actions_t files;
	posix_spawnattr_t attr;
	sigset_t none, usual;
	int fault;

	sigemptyset(&none);
	sigemptyset(&usual);
	sigaddset(&usual, SIGINT);
	sigaddset(&usual, SIGTERM);
	fault = posix_spawn_file_actions_init(&files);
	if (fault)
		return fault;
	fault = posix_spawnattr_init(&attr);
	if (fault) {
		posix_spawn_file_actions_destroy(&files);
		return fault;
	}
	posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
	posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, f->out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
	posix_spawn_file_actions_addopen(&files, STDERR_FILENO, f->err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
	posix_spawnattr_setpgroup(&attr, 0);
	posix_spawnattr_setsigmask(&attr, &none);
	posix_spawnattr_setsigdefault(&attr, &usual);
	posix_spawnattr_setflags(&attr, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
	fault = posix_spawnp(pid, t->program, &files, &attr, argv, environ);
	posix_spawnattr_destroy(&attr);
	posix_spawn_file_actions_destroy(&files);
	return fault;
}

static double cpu_seconds(pid_t pid)
{
	struct timespec now;
	clockid_t clock;

	if (clock_getcpuclockid(pid, &clock) || clock_gettime(clock, &now))
		return 0;
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A busy machine makes it late, but not work more; who waits for something that never comes does neither. */
static bool too_late(const struct trade_child *c, pid_t pid, double began)
{
	double taken = clock_seconds() - began;

	if (c->limit > 0)
		return taken >= c->limit;
	return c->cpu_limit > 0 && (taken > PATIENCE * c->cpu_limit || cpu_seconds(pid) >= c->cpu_limit);
}

/* Until it has ended. SIGCHLD is blocked and waited for, so that its end is seen at once; our own signals
 * end the wait too. */
static pid_t wait_for(pid_t pid, struct trade_child *c, double began, int *how, struct rusage *usage)
{
	sigset_t child, before;
	bool killed = false;
	pid_t got;

	sigemptyset(&child);
	sigaddset(&child, SIGCHLD);
	sigprocmask(SIG_BLOCK, &child, &before);
	while (!(got = wait4(pid, how, WNOHANG, usage)) || (got < 0 && errno == EINTR)) {
		double left = c->limit > 0 ? began + c->limit - clock_seconds() : PAUSE;
		struct timespec pause = { 0 };

		if (!killed && (interrupt_asked() || too_late(c, pid, began))) {
			c->late = !interrupt_asked();
			killed = true;
			kill(pid, SIGKILL);
		}
		left = killed || left > PAUSE ? PAUSE : left > 0 ? left : 0;
		pause.tv_nsec = (long)(left * 1e9);
		sigtimedwait(&child, NULL, &pause);
	}
	sigprocmask(SIG_SETMASK, &before, NULL);
	return got;
}

static double seconds(const struct timeval *v)
{
	return (double)v->tv_sec + 1e-6 * (double)v->tv_usec;
}

/* {"kind": "end", "phase": "rendering", "elapsed": 0.25} */
static void take_phase(struct trade_child *c, json_t *v)
{
	static const struct {
		const char *phase;
		enum trade_value value;
	} known[] = {
		{ "reading", TRADE_READ }, { "building", TRADE_BUILD }, { "rendering", TRADE_RENDER },
	};
	const char *kind, *phase;
	double elapsed;

	if (json_unpack(v, "{s:s, s:s, s:F}", "kind", &kind, "phase", &phase, "elapsed", &elapsed) ||
	    strcmp(kind, "end") != 0)
		return;
	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++) {
		if (!strcmp(phase, known[i].phase))
			c->value[known[i].value] = elapsed;
	}
}

static void read_phases(struct trade_child *c, const char *path)
{
	FILE *in = fopen(path, "r");
	char line[1024];

	if (!in)
		return;
	while (fgets(line, sizeof(line), in)) {
		json_t *v = json_loads(line, 0, NULL);

		take_phase(c, v);
		json_decref(v);
	}
	fclose(in);
}

/* The first error it reported, or else the last line of what it said. */
static void read_message(struct trade_child *c, const char *path)
{
	static const char own[] = "alidade: ";
	FILE *in = fopen(path, "r");
	char line[sizeof(c->message)];
	bool found = false;

	while (in && !found && fgets(line, sizeof(line), in)) {
		const char *text = strncmp(line, own, sizeof(own) - 1) ? line : line + sizeof(own) - 1;

		found = strstr(line, "error: ") != NULL;
		snprintf(c->message, sizeof(c->message), "%.*s", (int)strcspn(text, "\n"), text);
	}
	if (in)
		fclose(in);
}

static uint32_t arguments(const struct trade *t, const struct trade_child *c, char (*own)[TRADE_PATH + 64],
			  char **argv)
{
	uint32_t n = 0;

	argv[n++] = (char *)(uintptr_t)t->program;
	for (uint32_t i = 0; i < t->base_count && n < ARGS - 10; i++)
		argv[n++] = (char *)(uintptr_t)t->base[i];
	for (uint32_t i = 0; c->option[i] && n < ARGS - 10; i++)
		argv[n++] = (char *)(uintptr_t)c->option[i];
	snprintf(own[0], sizeof(*own), "--seed=%" PRIu64, c->seed);
	snprintf(own[1], sizeof(*own), "--output=%s", c->picture);
	argv[n++] = own[0];
	argv[n++] = own[1];
	argv[n++] = (char *)(uintptr_t) "--progress=json";
	if (c->stats) {
		snprintf(own[2], sizeof(*own), "--stats=%s", c->stats);
		argv[n++] = own[2];
	}
	argv[n++] = (char *)(uintptr_t) "--";
	argv[n++] = (char *)(uintptr_t)t->scene;
	argv[n] = NULL;
	return n;
}

static void end_of(struct trade_child *c, int how)
{
	if (c->late)
		snprintf(c->message, sizeof(c->message), "stopped after %.3g s%s; --limit allows more",
			 c->limit > 0 ? c->limit : c->cpu_limit, c->limit > 0 ? "" : " of CPU time");
	else if (WIFSIGNALED(how))
		snprintf(c->message, sizeof(c->message), "ended by signal %d (%s)", WTERMSIG(how),
			 strsignal(WTERMSIG(how)));
	c->status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
}

enum status trade_child_run(struct trade *t, struct trade_child *c)
{
	char own[3][TRADE_PATH + 64], *argv[ARGS];
	struct rusage usage = { 0 };
	double began;
	struct files f;
	int fault, how = 0;
	pid_t pid;

	snprintf(f.out, sizeof(f.out), "%s/out", t->work);
	snprintf(f.err, sizeof(f.err), "%s/err", t->work);
	arguments(t, c, own, argv);
	for (int v = 0; v < TRADE_VALUES; v++)
		c->value[v] = (double)NAN;
	c->late = false;
	c->message[0] = 0;
	began = clock_seconds();
	fault = spawn(t, &f, argv, &pid);
	if (fault)
		return diag_fail(&t->diag, STATUS_FAILED, NULL, "%s could not be started: %s; --program names it",
				 t->program, strerror(fault));
	if (wait_for(pid, c, began, &how, &usage) < 0)
		return diag_fail(&t->diag, STATUS_FAILED, NULL, "%s was lost: %s", t->program, strerror(errno));
	c->value[TRADE_PROCESS] = clock_seconds() - began;
	if (interrupt_asked())
		return STATUS_SIGINT;
	c->value[TRADE_CPU] = seconds(&usage.ru_utime) + seconds(&usage.ru_stime);
	c->value[TRADE_MEMORY] = 1024 * (double)usage.ru_maxrss; /* kibibytes on Linux */
	read_phases(c, f.out);
	end_of(c, how);
	if (c->status && !c->message[0])
		read_message(c, f.err);
	if (c->status && !c->message[0])
		snprintf(c->message, sizeof(c->message), "ended with status %d", c->status);
	return STATUS_OK;
}
