/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "peers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef HAVE_EMBREE
bool peer_is(const char *name)
{
	if (strncmp(name, "embree", 6) == 0 && name[6] >= '1' && name[6] <= '8') {
		fprintf(stderr, "rays: built without Embree (Debian has it as libembree-dev)\n");
		exit(1);
	}
	return false;
}

struct peer *peer_open(const char *name, const ald_prims *p, uint32_t threads, double *seconds)
{
	(void)name, (void)p, (void)threads, (void)seconds;
	exit(1);
}

double peer_bytes(const struct peer *p)
{
	(void)p;
	return 0;
}

void peer_close(struct peer *p)
{
	(void)p;
}

void peer_fire(struct peer *p, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n, uint32_t hints)
{
	(void)p, (void)ray, (void)hit, (void)hidden, (void)n, (void)hints;
}
#else
#include <embree3/rtcore.h>
#include <time.h>
#include <xmmintrin.h>

struct peer {
	RTCDevice device;
	RTCScene scene;
	unsigned width;
	ssize_t bytes;
};

bool peer_is(const char *name)
{
	return strncmp(name, "embree", 6) == 0 && (name[6] == '1' || name[6] == '8');
}

static bool monitor(void *ptr, ssize_t bytes, bool post)
{
	(void)post;
	((struct peer *)ptr)->bytes += bytes;
	return true;
}

static double clock_now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

struct peer *peer_open(const char *name, const ald_prims *prims, uint32_t threads, double *seconds)
{
	struct peer *p = calloc(1, sizeof(*p));
	const char *isa = strstr(name, "isa="), *splits = strstr(name, "splits=");
	char config[200];
	RTCGeometry g;
	float *v;
	uint32_t *t, top = 0;
	ssize_t before;

	p->width = (unsigned)atoi(name + 6);
	snprintf(config, sizeof(config), "threads=%u,set_affinity=0%s%.40s", threads, isa ? "," : "", isa ? isa : "");
	if (splits)
		snprintf(config + strlen(config), 50, ",max_spatial_split_replications=%.5s", splits + 7);
	for (char *c = config; *c; c++)
		*c = *c == ':' ? 0 : *c;
	p->device = rtcNewDevice(config);
	if (!p->device)
		exit(1);
	rtcSetDeviceMemoryMonitorFunction(p->device, monitor, p);
	p->scene = rtcNewScene(p->device);
	rtcSetSceneFlags(p->scene, strstr(name, "robust") ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
	rtcSetSceneBuildQuality(p->scene, strstr(name, "high") ? RTC_BUILD_QUALITY_HIGH :
					  strstr(name, "low") ? RTC_BUILD_QUALITY_LOW :
								RTC_BUILD_QUALITY_MEDIUM);
	g = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	t = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, prims->tri_count);
	memcpy(t, prims->index, prims->tri_count * (size_t)12);
	for (uint32_t i = 0; i < 3 * prims->tri_count; i++)
		top = t[i] > top ? t[i] : top;
	v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, top + (size_t)1);
	for (uint32_t i = 0; i < 3 * (top + 1); i++)
		v[i] = (float)((const double *)prims->vertex)[i];
	if (strstr(name, "low"))
		rtcSetGeometryBuildQuality(g, RTC_BUILD_QUALITY_LOW);
	rtcCommitGeometry(g);
	rtcAttachGeometry(p->scene, g);
	rtcReleaseGeometry(g);
	before = p->bytes;
	*seconds = clock_now();
	rtcCommitScene(p->scene);
	*seconds = clock_now() - *seconds;
	p->bytes -= before;
	return p;
}

double peer_bytes(const struct peer *p)
{
	return (double)p->bytes;
}

void peer_close(struct peer *p)
{
	rtcReleaseScene(p->scene);
	rtcReleaseDevice(p->device);
	free(p);
}

static void fire1(struct peer *p, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n,
		  struct RTCIntersectContext *c)
{
	for (uint32_t i = 0; i < n; i++) {
		const ald_ray *a = &ray[i];
		struct RTCRayHit r;

		r.ray = (struct RTCRay){ (float)a->org.x, (float)a->org.y, (float)a->org.z, (float)a->tmin,
					 (float)a->dir.x, (float)a->dir.y, (float)a->dir.z, 0, (float)a->tmax,
					 UINT32_MAX, 0, 0 };
		if (hidden) {
			rtcOccluded1(p->scene, c, &r.ray);
			hidden[i] = r.ray.tfar < 0;
			continue;
		}
		r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
		rtcIntersect1(p->scene, c, &r);
		if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
			continue;
		hit[i].t = (double)r.ray.tfar;
		hit[i].prim = r.hit.primID;
		hit[i].u = (double)r.hit.u;
		hit[i].v = (double)r.hit.v;
	}
}

#define FIRE(W)                                                                                      \
	static void fire##W(struct peer *p, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n, \
			    struct RTCIntersectContext *c)                                             \
	{                                                                                            \
		for (uint32_t at = 0; at < n; at += W) {                                               \
			struct RTCRayHit##W r;                                                         \
			int valid[W] __attribute__((aligned(64)));                                     \
\
			for (uint32_t i = 0; i < W; i++) {                                             \
				const ald_ray *a = &ray[at + i < n ? at + i : n - 1];                  \
\
				valid[i] = at + i < n ? -1 : 0;                                        \
				r.ray.org_x[i] = (float)a->org.x;                                      \
				r.ray.org_y[i] = (float)a->org.y;                                      \
				r.ray.org_z[i] = (float)a->org.z;                                      \
				r.ray.dir_x[i] = (float)a->dir.x;                                      \
				r.ray.dir_y[i] = (float)a->dir.y;                                      \
				r.ray.dir_z[i] = (float)a->dir.z;                                      \
				r.ray.tnear[i] = (float)a->tmin;                                       \
				r.ray.tfar[i] = (float)a->tmax;                                        \
				r.ray.time[i] = 0;                                                     \
				r.ray.mask[i] = UINT32_MAX;                                            \
				r.ray.flags[i] = 0;                                                    \
				r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;                             \
			}                                                                              \
			if (hidden)                                                                    \
				rtcOccluded##W(valid, p->scene, c, &r.ray);                            \
			else                                                                           \
				rtcIntersect##W(valid, p->scene, c, &r);                               \
			for (uint32_t i = 0; i < W && at + i < n; i++) {                               \
				if (hidden) {                                                          \
					hidden[at + i] = r.ray.tfar[i] < 0;                            \
				} else if (r.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {               \
					hit[at + i].t = (double)r.ray.tfar[i];                         \
					hit[at + i].prim = r.hit.primID[i];                            \
					hit[at + i].u = (double)r.hit.u[i];                            \
					hit[at + i].v = (double)r.hit.v[i];                            \
				}                                                                      \
			}                                                                              \
		}                                                                                      \
	}

FIRE(8)
FIRE(16)

void peer_fire(struct peer *p, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n, uint32_t hints)
{
	struct RTCIntersectContext c;
	unsigned modes = _mm_getcsr();

	rtcInitIntersectContext(&c);
	c.flags = hints & ALD_COHERENT ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT :
					 RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
	_mm_setcsr(modes | 0x8040); /* as Embree asks for */
	if (p->width == 1)
		fire1(p, ray, hit, hidden, n, &c);
	else if (p->width == 8)
		fire8(p, ray, hit, hidden, n, &c);
	else
		fire16(p, ray, hit, hidden, n, &c);
	_mm_setcsr(modes);
}
#endif
