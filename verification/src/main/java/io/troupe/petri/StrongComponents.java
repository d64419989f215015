package io.troupe.petri;

import java.util.Arrays;
import java.util.BitSet;

/**
 * The strongly connected components of an explored graph, by Tarjan's algorithm (1972). An explicit stack replaces the
 * recursion, which would be as deep as the graph.
 */
final class StrongComponents {
    private static final int NEW = 0;

    private final Exploration graph;
    /** The component of each marking, numbered from 0. */
    private final int[] component;
    /**
     * The order in which markings were found, from 1; afterwards the lowest such number on the stack that is reachable.
     */
    private final int[] low;
    /** By marking: the next edge to follow. */
    private final int[] nextEdge;

    private final int[] path;
    private final int[] stack;
    private int stacked;
    private int seen;
    private int count;

    private StrongComponents(Exploration graph) {
        this.graph = graph;
        var size = graph.store.size();
        component = new int[size];
        Arrays.fill(component, -1);
        low = new int[size];
        nextEdge = new int[size];
        path = new int[size];
        stack = new int[size];
    }

    /** The markings of each terminal component: it has no edge to another component and no open marking. */
    static int[][] terminal(Exploration graph) {
        var components = new StrongComponents(graph);
        // every marking is reachable from the first
        components.search(0);
        return components.terminal();
    }

    private void search(int root) {
        var depth = 0;
        path[0] = root;
        enter(root);
        var order = new int[path.length];
        order[root] = seen;
        while (depth >= 0) {
            var at = path[depth];
            if (nextEdge[at] < graph.edgeEnd(at)) {
                var to = graph.edgeTarget.get(nextEdge[at]++);
                if (low[to] == NEW) {
                    enter(to);
                    order[to] = seen;
                    path[++depth] = to;
                } else if (component[to] < 0) {
                    low[at] = Math.min(low[at], order[to]);
                }
                continue;
            }
            if (low[at] == order[at]) {
                close(at);
            }
            depth--;
            if (depth >= 0) {
                low[path[depth]] = Math.min(low[path[depth]], low[at]);
            }
        }
    }

    private void enter(int marking) {
        low[marking] = ++seen;
        nextEdge[marking] = graph.edgeStart(marking);
        stack[stacked++] = marking;
    }

    private void close(int root) {
        int member;
        do {
            member = stack[--stacked];
            component[member] = count;
        } while (member != root);
        count++;
    }

    private int[][] terminal() {
        var left = new BitSet(count);
        for (var from = 0; from < component.length; from++) {
            if (graph.isOpen(from)) {
                left.set(component[from]);
            }
            for (var edge = graph.edgeStart(from); edge < graph.edgeEnd(from); edge++) {
                if (component[graph.edgeTarget.get(edge)] != component[from]) {
                    left.set(component[from]);
                }
            }
        }
        var members = new IntList[count];
        // in the order of the markings, so that the nearest comes first
        var inOrder = new IntList();
        for (var marking = 0; marking < component.length; marking++) {
            var of = component[marking];
            if (!left.get(of)) {
                if (members[of] == null) {
                    members[of] = new IntList();
                    inOrder.add(of);
                }
                members[of].add(marking);
            }
        }
        return Arrays.stream(inOrder.toArray())
                .mapToObj(of -> members[of].toArray())
                .toArray(int[][]::new);
    }
}
