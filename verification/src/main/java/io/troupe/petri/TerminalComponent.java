package io.troupe.petri;

import java.util.Arrays;
import java.util.List;

/**
 * A terminal strongly connected component of a reachability graph: markings that can all reach each other and no
 * others. A dead marking is one of size 1 without firings. A component in which some transition never fires is a
 * partial deadlock.
 *
 * <p><b>Role.</b> From {@link Liveness#terminalComponents}.
 *
 * <p><b>Threads.</b> Immutable.
 */
public final class TerminalComponent {
    private final ReachabilityGraph graph;
    private final int[] members;
    private final boolean[] fires;

    /** Creates a component that owns {@code members}, which are in ascending order. */
    TerminalComponent(ReachabilityGraph graph, int[] members) {
        this.graph = graph;
        this.members = members;
        var found = graph.found();
        // no array for dead markings: a net can have a million of them
        var isDead = members.length == 1 && found.edgeStart(members[0]) == found.edgeEnd(members[0]);
        fires = new boolean[isDead ? 0 : graph.net().transitions().size()];
        for (var member : members) {
            for (var edge = found.edgeStart(member); edge < found.edgeEnd(member); edge++) {
                fires[found.edgeTransition.get(edge)] = true;
            }
        }
    }

    int[] members() {
        return members;
    }

    /** The number of markings. */
    public int size() {
        return members.length;
    }

    /** The markings, nearest to the initial one first. */
    public List<ReachabilityGraph.State> states() {
        return Arrays.stream(members).mapToObj(graph::state).toList();
    }

    /** The marking nearest to the initial one; its trace shows how the net gets into this component. */
    public ReachabilityGraph.State entry() {
        return graph.state(members[0]);
    }

    public boolean contains(ReachabilityGraph.State state) {
        return graph.state(state.index()).equals(state) && Arrays.binarySearch(members, state.index()) >= 0;
    }

    /** Whether {@code transition} may fire in one of the markings. */
    public boolean fires(Transition transition) {
        var all = graph.net().transitions();
        if (transition.index() >= all.size() || !all.get(transition.index()).equals(transition)) {
            throw new IllegalArgumentException(
                    "transition " + transition + " is not of net " + graph.net().name());
        }
        return fires(transition.index());
    }

    /** The transitions that never fire again once the net is in this component; all of them for a dead marking. */
    public List<Transition> neverFired() {
        return graph.net().transitions().stream().filter(t -> !fires(t.index())).toList();
    }

    private boolean fires(int transition) {
        return transition < fires.length && fires[transition];
    }

    /** Whether this is a single marking in which no transition may fire. */
    public boolean isDead() {
        return neverFired().size() == graph.net().transitions().size();
    }

    /** The size, the entry and the transitions that never fire. */
    @Override
    public String toString() {
        return size() + (size() == 1 ? " marking" : " markings") + " entered at " + entry() + ", never fired: "
                + Shortened.list(neverFired());
    }
}
