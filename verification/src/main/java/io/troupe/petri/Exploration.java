package io.troupe.petri;

import java.util.BitSet;
import org.jspecify.annotations.Nullable;

/**
 * The breadth-first search over the markings of a net. {@link ReachabilityGraph} and {@link DeadlockSearch} report what
 * it leaves in its fields.
 *
 * <p>Out of memory, it ends between two steps, so that its data stays consistent: a list may then hold one value too
 * many at its end, which is never read.
 */
final class Exploration {
    final PetriNet net;
    MarkingStore store;
    /**
     * By marking, except for the first: the marking that it was first reached from, and the transition that led to it.
     */
    final IntList parent = new IntList();

    final IntList parentTransition = new IntList();
    /** By expanded marking: the index of its first edge. */
    private final IntList edgeStart = new IntList();

    final IntList edgeTransition = new IntList();
    final IntList edgeTarget = new IntList();
    final IntList dead = new IntList();
    final long[] most;
    final boolean[] fired;
    /** The markings whose successors are incomplete because of the limit. */
    private final BitSet open = new BitSet();

    /** The markings to expand, newest last; only if the newest come first. */
    private final IntList waiting = new IntList(0);

    /** How many markings are expanded, that is: their successors were computed. All others are open. */
    private int expanded;

    /** How many firings were followed, whether or not they were stored as edges. */
    private long edges;

    SearchEnd end = SearchEnd.COMPLETE;

    private final SearchLimits limits;
    private final int maxMarkings;
    private final boolean keepsEdges;
    private final Chooser chooser;
    private final TokenGame game;
    private final CompiledNet compiled;
    final Symmetry symmetry;
    private final Symmetry.@Nullable Sorter sorter;
    private final long[] unsorted;
    private final int[] chosen;
    private final long[] tokens;
    private long[][] packedChanges;
    private long[] successor;

    /**
     * Creates a search that stores one marking of each orbit of {@code symmetry} and the first way to it; with
     * {@code keepsEdges} it stores all edges too.
     */
    Exploration(PetriNet net, Chooser chooser, Symmetry symmetry, SearchLimits limits, boolean keepsEdges) {
        this.net = net;
        this.chooser = chooser;
        game = new TokenGame(net);
        compiled = net.compiled();
        this.symmetry = symmetry;
        sorter = symmetry.isTrivial() ? null : new Symmetry.Sorter(symmetry);
        unsorted = new long[net.places().size()];
        this.limits = limits;
        this.keepsEdges = keepsEdges;
        maxMarkings = Math.min(limits.maxMarkings(), MarkingStore.MAX_SIZE);
        var transitions = net.transitions();
        chosen = new int[transitions.size()];
        most = new long[net.places().size()];
        fired = new boolean[transitions.size()];
        tokens = net.initialMarking().toArray();
        store = new MarkingStore(tokens.length, 1);
        packedChanges = pack();
        successor = new long[store.words()];
    }

    void run() {
        start();
        try {
            search();
        } catch (OutOfMemoryError e) {
            end = SearchEnd.MEMORY;
        }
        for (var from = expanded; from < store.size(); from++) {
            read(from);
        }
    }

    /** Goes on from the newest marking first, and ends at the first dead one; does not tell which markings are open. */
    void runToFirstDead() {
        start();
        try {
            searchNewestFirst();
        } catch (OutOfMemoryError e) {
            end = SearchEnd.MEMORY;
        }
    }

    private void start() {
        for (var held : tokens) {
            widenTo(held);
        }
        store.add(store.pack(tokens));
        parent.add(-1);
        parentTransition.add(-1);
    }

    private void search() {
        while (expanded < store.size()) {
            if (!step(expanded)) {
                return;
            }
        }
        if (!open.isEmpty()) {
            end = SearchEnd.LIMIT;
        }
    }

    private void searchNewestFirst() {
        waiting.add(0);
        while (waiting.size() > 0 && dead.size() == 0) {
            var known = store.size();
            if (!step(waiting.removeLast())) {
                return;
            }
            for (var id = known; id < store.size(); id++) {
                waiting.add(id);
            }
        }
        if (!open.isEmpty()) {
            end = SearchEnd.LIMIT;
        }
    }

    /** Expands a marking; false if the search has ended. */
    private boolean step(int from) {
        if (limits.cancelled().getAsBoolean()) {
            end = SearchEnd.CANCELLED;
            return false;
        }
        if (!hasRoom(store.bytesWith(chosen.length))) {
            end = SearchEnd.MEMORY;
        } else {
            expand(from);
        }
        if (end == SearchEnd.MEMORY) {
            return false;
        }
        expanded++;
        if (expanded % limits.markingsPerReport() == 0) {
            limits.report().accept(new SearchProgress(store.size(), expanded, edgeCount(), dead.size()));
        }
        return true;
    }

    /** Whether the memory limit allows another step, after which the marking store takes {@code storeBytes}. */
    private boolean hasRoom(long storeBytes) {
        if (limits.maxBytes() == Long.MAX_VALUE) {
            return true;
        }
        var steps = chosen.length;
        var ways = parent.bytesWith(steps) * 2 + dead.bytesWith(1);
        ways += waiting.size() > 0 ? waiting.bytesWith(steps) : 0;
        var kept = keepsEdges ? edgeTarget.bytesWith(steps) * 2 + edgeStart.bytesWith(1) : 0;
        return storeBytes + ways + kept <= limits.maxBytes();
    }

    private void expand(int from) {
        read(from);
        if (keepsEdges) {
            edgeStart.add(edgeTarget.size());
        }
        game.moveTo(tokens);
        var count = chooser.choose(game, chosen);
        for (var i = 0; i < count && end != SearchEnd.MEMORY; i++) {
            var t = chosen[i];
            fired[t] = true;
            var to = reach(from, t);
            if (to >= 0) {
                if (keepsEdges) {
                    edgeTransition.add(t);
                    edgeTarget.add(to);
                }
                edges++;
            } else {
                open.set(from);
            }
        }
        if (count == 0) {
            dead.add(from);
        }
    }

    private void read(int id) {
        store.read(id, tokens);
        for (var place = 0; place < tokens.length; place++) {
            most[place] = Math.max(most[place], tokens[place]);
        }
    }

    boolean keepsEdges() {
        return keepsEdges;
    }

    /** The index of a marking's first edge; its edges end before {@link #edgeEnd}. */
    int edgeStart(int id) {
        return id < edgeStart.size() ? edgeStart.get(id) : edgeTarget.size();
    }

    int edgeEnd(int id) {
        return edgeStart(id + 1);
    }

    int edgeCount() {
        return (int) Math.min(Integer.MAX_VALUE, edges);
    }

    /** Whether a marking's successors are incomplete: some were dropped at the limit, or it was never expanded. */
    boolean isOpen(int id) {
        return id >= expanded || open.get(id);
    }

    int openCount() {
        return open.get(0, expanded).cardinality() + store.size() - expanded;
    }

    /** The number of the marking that firing t leads to, or -1 if that marking is new and there is no room for it. */
    private int reach(int from, int t) {
        var places = compiled.changed[t];
        for (var i = 0; i < places.length; i++) {
            var gain = compiled.changes[t][i];
            if (gain > 0) {
                var held = PetriNet.sum(tokens[places[i]], gain, net.places().get(places[i]));
                if (held > store.capacity() && !hasRoom(3 * store.bytesWith(1))) {
                    end = SearchEnd.MEMORY;
                    return -1;
                }
                widenTo(held);
            }
        }
        store.plus(from, packedChanges[t], successor);
        if (sorter != null) {
            store.unpack(successor, unsorted);
            sorter.sort(unsorted);
            store.pack(unsorted, successor);
        }
        var known = store.find(successor);
        if (known >= 0 || store.size() == maxMarkings) {
            return known;
        }
        parent.add(from);
        parentTransition.add(t);
        return store.add(successor);
    }

    private void widenTo(long held) {
        if (held <= store.capacity()) {
            return;
        }
        while (held > store.capacity()) {
            store = store.widened();
        }
        packedChanges = pack();
        successor = new long[store.words()];
    }

    private long[][] pack() {
        return net.transitions().stream().map(store::change).toArray(long[][]::new);
    }
}
