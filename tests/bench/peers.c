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

#include "base/clock.h"

/* ---- names ---- */

bool peer_parse(const char *name, struct peer_config *c, struct peer_way *way)
{
	static const struct {
		const char *name;
		unsigned width;
	} widths[] = { { "1", PEER_1 }, { "8", PEER_8 }, { "16", PEER_16 }, { "1M", PEER_1M }, { "Np", PEER_NP } };
	static const char *const isas[] = { "sse2", "sse4.2", "avx", "avx2", "avx512" };
	size_t length = strcspn(name, ":");

	*c = (struct peer_config){ .quality = PEER_MEDIUM, .threads = 1 };
	*way = (struct peer_way){ 0, -1 };
	for (unsigned i = 0; i < 5 && strncmp(name, "embree", 6) == 0; i++) {
		if (length - 6 == strlen(widths[i].name) && !strncmp(name + 6, widths[i].name, length - 6))
			way->width = widths[i].width;
	}
	if (!way->width)
		return false;
	for (unsigned i = 0; i < 5; i++) {
		const char *at = strstr(name, ":isa=");

		if (at && !strncmp(at + 5, isas[i], strcspn(at + 5, ":")) &&
		    strlen(isas[i]) == strcspn(at + 5, ":"))
			c->isa = isas[i];
	}
	c->robust = strstr(name, ":robust");
	c->huge = strstr(name, ":huge");
	c->quality = strstr(name, ":high") ? PEER_HIGH : strstr(name, ":low") ? PEER_LOW : PEER_MEDIUM;
	if (strstr(name, ":splits="))
		c->splits = atof(strstr(name, ":splits=") + 8);
	if (strstr(name, ":coherent"))
		way->coherent = 1;
	if (strstr(name, ":incoherent"))
		way->coherent = 0;
	return true;
}

void peer_name(const struct peer_config *c, struct peer_way way, char out[96])
{
	char width[8], splits[40] = "";

	snprintf(width, sizeof(width), way.width == PEER_1M ? "1M" : way.width == PEER_NP ? "Np" : "%u", way.width);
	if (c->splits > 0)
		snprintf(splits, sizeof(splits), ":splits=%g", c->splits);
	snprintf(out, 96, "embree%s%s%s%s%s%s%s%s", width, c->isa ? ":isa=" : "", c->isa ? c->isa : "",
		 c->robust ? ":robust" : "", c->huge ? ":huge" : "",
		 c->quality == PEER_LOW ? ":low" : c->quality == PEER_HIGH ? ":high" : "", splits,
		 way.coherent < 0 || way.width == PEER_1 ? "" : way.coherent ? ":coherent" : ":incoherent");
}

#ifndef HAVE_EMBREE
bool peer_there(void)
{
	return false;
}

struct peer_mesh *peer_mesh_new(const ald_prims *prims, uint32_t vertices, const float (*place)[12], uint32_t places)
{
	(void)prims, (void)vertices, (void)place, (void)places;
	return NULL;
}

void peer_mesh_free(struct peer_mesh *m)
{
	(void)m;
}

struct peer *peer_open(const struct peer_config *c, const struct peer_mesh *m)
{
	(void)c, (void)m;
	return NULL;
}

double peer_bytes(const struct peer *p)
{
	(void)p;
	return 0;
}

double peer_peak(const struct peer *p)
{
	(void)p;
	return 0;
}

double peer_seconds(const struct peer *p)
{
	(void)p;
	return 0;
}

void peer_close(struct peer *p)
{
	(void)p;
}

void peer_fire(const struct peer *p, struct peer_way way, const ald_ray *ray, ald_hit *hit, uint8_t *hidden,
	       uint32_t n, uint32_t hints)
{
	(void)p, (void)way, (void)ray, (void)hit, (void)hidden, (void)n, (void)hints;
}
#else
#include <embree3/rtcore.h>
#include <stdatomic.h>
#include <xmmintrin.h>

enum { MOST = 1024 };

struct peer {
	RTCDevice device;
	RTCScene scene, inner; /* inner: what is there many times, or NULL */
	_Atomic int64_t bytes, peak;
	double seconds;
};

struct peer_mesh {
	float *vertex;
	const uint32_t *index;
	uint32_t vertices, triangles;
	const float (*place)[12];
	uint32_t places;
};

bool peer_there(void)
{
	return true;
}

struct peer_mesh *peer_mesh_new(const ald_prims *prims, uint32_t vertices, const float (*place)[12], uint32_t places)
{
	struct peer_mesh *m = calloc(1, sizeof(*m));

	m->place = place;
	m->places = places;
	m->vertices = vertices;
	m->triangles = prims->tri_count;
	m->index = prims->index;
	m->vertex = malloc((3 * (size_t)vertices + 4) * sizeof(float)); /* it reads 16 bytes at a time */
	for (size_t i = 0; i < 3 * (size_t)vertices; i++)
		m->vertex[i] = (float)((const double *)prims->vertex)[i];
	return m;
}

void peer_mesh_free(struct peer_mesh *m)
{
	if (m)
		free(m->vertex);
	free(m);
}

static const enum RTCBuildQuality build_quality[] = { RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM,
						      RTC_BUILD_QUALITY_HIGH };

static bool monitor(void *ptr, ssize_t bytes, bool post)
{
	struct peer *p = ptr;
	int64_t now = atomic_fetch_add(&p->bytes, bytes) + bytes, peak = p->peak;

	(void)post;
	while (now > peak && !atomic_compare_exchange_weak(&p->peak, &peak, now))
		;
	return true;
}

static RTCScene new_scene(const struct peer *p, const struct peer_config *c)
{
	RTCScene scene = rtcNewScene(p->device);

	rtcSetSceneFlags(scene, c->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
	rtcSetSceneBuildQuality(scene, build_quality[c->quality]);
	return scene;
}

static void add_mesh(const struct peer *p, RTCScene scene, const struct peer_config *c, const struct peer_mesh *m)
{
	RTCGeometry g = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_TRIANGLE);

	rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m->index, 0, 12, m->triangles);
	rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m->vertex, 0, 12, m->vertices);
	rtcSetGeometryBuildQuality(g, build_quality[c->quality]);
	rtcCommitGeometry(g);
	rtcAttachGeometry(scene, g);
	rtcReleaseGeometry(g);
}

static void add_places(struct peer *p, const struct peer_mesh *m)
{
	for (uint32_t i = 0; i < m->places; i++) {
		RTCGeometry g = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_INSTANCE);

		rtcSetGeometryInstancedScene(g, p->inner);
		rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m->place[i]);
		rtcCommitGeometry(g);
		rtcAttachGeometry(p->scene, g);
		rtcReleaseGeometry(g);
	}
}

struct peer *peer_open(const struct peer_config *c, const struct peer_mesh *m)
{
	struct peer *p = calloc(1, sizeof(*p));
	char config[160];
	double start;

	snprintf(config, sizeof(config), "threads=%u,set_affinity=0,hugepages=%d%s%s", c->threads, c->huge,
		 c->isa ? ",isa=" : "", c->isa ? c->isa : "");
	if (c->splits > 0)
		snprintf(config + strlen(config), 60, ",max_spatial_split_replications=%g", c->splits);
	p->device = rtcNewDevice(config);
	if (!p->device || rtcGetDeviceError(p->device)) {
		if (p->device)
			rtcReleaseDevice(p->device);
		free(p);
		return NULL;
	}
	rtcSetDeviceMemoryMonitorFunction(p->device, monitor, p);
	p->scene = new_scene(p, c);
	if (m->place)
		p->inner = new_scene(p, c);
	add_mesh(p, m->place ? p->inner : p->scene, c, m);
	p->bytes = p->peak = 0;
	start = clock_seconds();
	if (m->place) {
		rtcCommitScene(p->inner);
		add_places(p, m);
	}
	rtcCommitScene(p->scene);
	p->seconds = clock_seconds() - start;
	return p;
}

double peer_bytes(const struct peer *p)
{
	return (double)p->bytes;
}

double peer_peak(const struct peer *p)
{
	return (double)p->peak;
}

double peer_seconds(const struct peer *p)
{
	return p->seconds;
}

void peer_close(struct peer *p)
{
	rtcReleaseScene(p->scene);
	if (p->inner)
		rtcReleaseScene(p->inner);
	rtcReleaseDevice(p->device);
	free(p);
}

/* ---- rays one by one, and as structs one after another ---- */

static inline struct RTCRay ray1(const ald_ray *a)
{
	return (struct RTCRay){ (float)a->org.x, (float)a->org.y, (float)a->org.z, (float)a->tmin,
				(float)a->dir.x, (float)a->dir.y, (float)a->dir.z, 0, (float)a->tmax,
				UINT32_MAX, 0, 0 };
}

static inline void hit1(const struct RTCRayHit *r, ald_hit *hit)
{
	if (r->hit.geomID == RTC_INVALID_GEOMETRY_ID)
		return;
	hit->t = (double)r->ray.tfar;
	hit->prim = r->hit.primID;
	hit->u = (double)r->hit.u;
	hit->v = (double)r->hit.v;
}

static void fire1(RTCScene scene, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n,
		  struct RTCIntersectContext *c)
{
	for (uint32_t i = 0; i < n; i++) {
		struct RTCRayHit r;

		r.ray = ray1(&ray[i]);
		if (hidden) {
			rtcOccluded1(scene, c, &r.ray);
			hidden[i] = r.ray.tfar < 0;
			continue;
		}
		r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
		rtcIntersect1(scene, c, &r);
		hit1(&r, &hit[i]);
	}
}

static void fire1m(RTCScene scene, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n,
		   struct RTCIntersectContext *c)
{
	struct RTCRayHit r[MOST];
	struct RTCRay s[MOST];

	for (uint32_t i = 0; i < n && hidden; i++)
		s[i] = ray1(&ray[i]);
	for (uint32_t i = 0; i < n && !hidden; i++) {
		r[i].ray = ray1(&ray[i]);
		r[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
	}
	if (hidden)
		rtcOccluded1M(scene, c, s, n, sizeof(s[0]));
	else
		rtcIntersect1M(scene, c, r, n, sizeof(r[0]));
	for (uint32_t i = 0; i < n; i++) {
		if (hidden)
			hidden[i] = s[i].tfar < 0;
		else
			hit1(&r[i], &hit[i]);
	}
}

/* ---- and in arrays: FILL and EMPTY for whatever has the members ---- */

#define FILL(r, i, a)                                                                                                  \
	do {                                                                                                           \
		(r).ray.org_x[i] = (float)(a)->org.x;                                                                  \
		(r).ray.org_y[i] = (float)(a)->org.y;                                                                  \
		(r).ray.org_z[i] = (float)(a)->org.z;                                                                  \
		(r).ray.dir_x[i] = (float)(a)->dir.x;                                                                  \
		(r).ray.dir_y[i] = (float)(a)->dir.y;                                                                  \
		(r).ray.dir_z[i] = (float)(a)->dir.z;                                                                  \
		(r).ray.tnear[i] = (float)(a)->tmin;                                                                   \
		(r).ray.tfar[i] = (float)(a)->tmax;                                                                    \
		(r).ray.time[i] = 0;                                                                                   \
		(r).ray.mask[i] = UINT32_MAX;                                                                          \
		(r).ray.flags[i] = 0;                                                                                  \
		(r).hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;                                                           \
	} while (0)

#define EMPTY(r, i, h, hid)                                                                                            \
	do {                                                                                                           \
		if (hid) {                                                                                             \
			*(hid) = (r).ray.tfar[i] < 0;                                                                  \
		} else if ((r).hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {                                             \
			(h)->t = (double)(r).ray.tfar[i];                                                              \
			(h)->prim = (r).hit.primID[i];                                                                 \
			(h)->u = (double)(r).hit.u[i];                                                                 \
			(h)->v = (double)(r).hit.v[i];                                                                 \
		}                                                                                                      \
	} while (0)

#define FIRE(W)                                                                                                        \
	static void fire##W(RTCScene scene, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n,             \
			    struct RTCIntersectContext *c)                                                             \
	{                                                                                                              \
		for (uint32_t at = 0; at < n; at += W) {                                                               \
			struct RTCRayHit##W r;                                                                         \
			int valid[W] __attribute__((aligned(64)));                                                     \
\
			for (uint32_t i = 0; i < W; i++) {                                                             \
				valid[i] = at + i < n ? -1 : 0;                                                        \
				FILL(r, i, &ray[at + i < n ? at + i : n - 1]);                                         \
			}                                                                                              \
			if (hidden)                                                                                    \
				rtcOccluded##W(valid, scene, c, &r.ray);                                               \
			else                                                                                           \
				rtcIntersect##W(valid, scene, c, &r);                                                  \
			for (uint32_t i = 0; i < W && at + i < n; i++)                                                 \
				EMPTY(r, i, &hit[at + i], hidden ? &hidden[at + i] : NULL);                            \
		}                                                                                                      \
	}

FIRE(8)
FIRE(16)

static void fire_np(RTCScene scene, const ald_ray *ray, ald_hit *hit, uint8_t *hidden, uint32_t n,
		    struct RTCIntersectContext *c)
{
	float f[15][MOST] __attribute__((aligned(64)));
	unsigned u[6][MOST] __attribute__((aligned(64)));
	struct RTCRayHitNp r = {
		.ray = { f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], u[0], u[1], u[2] },
		.hit = { f[9], f[10], f[11], f[12], f[13], u[3], u[4], { u[5] } },
	};

	for (uint32_t i = 0; i < n; i++)
		FILL(r, i, &ray[i]);
	if (hidden)
		rtcOccludedNp(scene, c, &r.ray, n);
	else
		rtcIntersectNp(scene, c, &r, n);
	for (uint32_t i = 0; i < n; i++)
		EMPTY(r, i, &hit[i], hidden ? &hidden[i] : NULL);
}

void peer_fire(const struct peer *p, struct peer_way way, const ald_ray *ray, ald_hit *hit, uint8_t *hidden,
	       uint32_t n, uint32_t hints)
{
	struct RTCIntersectContext c;
	unsigned modes = _mm_getcsr();
	int coherent = way.coherent < 0 ? !!(hints & ALD_COHERENT) : way.coherent;

	rtcInitIntersectContext(&c);
	c.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
	_mm_setcsr(modes | 0x8040); /* as Embree asks for */
	switch (way.width) {
	case PEER_1:
		fire1(p->scene, ray, hit, hidden, n, &c);
		break;
	case PEER_8:
		fire8(p->scene, ray, hit, hidden, n, &c);
		break;
	case PEER_16:
		fire16(p->scene, ray, hit, hidden, n, &c);
		break;
	case PEER_1M:
		fire1m(p->scene, ray, hit, hidden, n, &c);
		break;
	default:
		fire_np(p->scene, ray, hit, hidden, n, &c);
	}
	_mm_setcsr(modes);
}
#endif
