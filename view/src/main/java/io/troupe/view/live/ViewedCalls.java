package io.troupe.view.live;

import io.troupe.actor.CallGraph;
import io.troupe.actor.Clock;
import io.troupe.view.Json;
import java.time.Duration;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

/** The calls between actors as text for pages, made at most once a second for all viewers. Any thread. */
final class ViewedCalls {
    private static final long SPACING_NANOS = 1_000_000_000;

    private final CallGraph graph = new CallGraph();
    private final Clock wall = Clock.system();
    private final long beginNanos = wall.nanos();
    private volatile Made last = new Made(beginNanos - SPACING_NANOS, "");

    private record Made(long nanos, String text) {}

    CallGraph graph() {
        return graph;
    }

    /** The counts of the last second, with the time at which they were read. */
    String text() {
        Made made = last;
        return wall.nanos() - made.nanos < SPACING_NANOS ? made.text : make();
    }

    private synchronized String make() {
        long now = wall.nanos();
        if (now - last.nanos >= SPACING_NANOS) {
            last = new Made(now, describe(graph.snapshot(), now - beginNanos));
        }
        return last.text;
    }

    private static String describe(CallGraph.Snapshot snapshot, long nanos) {
        Map<CallGraph.Node, Integer> numbers = new IdentityHashMap<>();
        snapshot.nodes().forEach(node -> numbers.put(node, numbers.size()));
        List<Json> nodes = snapshot.nodes().stream()
                .map(node -> new Json()
                        .put("space", node.space())
                        .put("name", node.name())
                        .put("turns", node.turns())
                        .put("waiting", node.waiting())
                        .put("stalls", node.stalls())
                        .put("busy", millis(node.busy()))
                        .put("longest", millis(node.longest()))
                        .put("current", millis(node.current())))
                .toList();
        List<Json> edges = snapshot.edges().stream()
                .map(edge -> new Json()
                        .put("from", numbers.get(edge.from()))
                        .put("to", numbers.get(edge.to()))
                        .put("calls", edge.calls())
                        .put("results", edge.results()))
                .toList();
        return new Json()
                .put("ms", nodes.isEmpty() ? 0 : TimeUnit.NANOSECONDS.toMillis(nanos))
                .put("nodes", Json.objects(nodes))
                .put("edges", Json.objects(edges))
                .toString();
    }

    private static double millis(Duration duration) {
        return duration.toNanos() / 1e6;
    }
}
