package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.ArrayList;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;

/**
 * Counts who calls whom, and how long actors wait and work, in the spaces that have it in their settings.
 *
 * {@snippet :
 * var graph = new CallGraph();
 * ActorSpace space = ActorSpace.create(SpaceSettings.named("shop").withCallObserver(graph));
 * Counter counter = space.spawn(Counter.class, Counter::new);
 * counter.add(5);
 * for (CallGraph.Edge edge : graph.snapshot().edges()) {
 *     log.add(edge.from().name() + " -> " + edge.to().name() + ": " + edge.calls());
 * }
 * }
 *
 * <p><b>Role.</b> Unnamed actors of one type count as one node, so that a graph is small however many actors there are.
 * Beyond {@value #MOST_NODES} nodes, those that follow count as the node {@value #OTHERS} of their space.
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> A call or a listener in such a space reads the clock twice and adds to
 * some counters; a call is wrapped, like one with a {@link TurnContext}. None in other spaces.
 */
public final class CallGraph implements CallObserver {
    /** The name of the node of threads that belong to no space. */
    public static final String OUTSIDE = "outside";

    /** The name of the node of what a space does for no actor, for example a task of {@link ActorSpace#execute}. */
    public static final String TASKS = "tasks";

    /** The name of the node for what exceeds the largest number of nodes. */
    public static final String OTHERS = "others";

    static final int MOST_NODES = 1_000;

    /**
     * An actor, or the unnamed actors of a type.
     *
     * @param space the name of its space; empty for threads that belong to none
     * @param name as in {@link ActorSettings}, or the simple name of its type
     * @param turns the calls, listeners, timers and results of callbacks that it has handled
     * @param waiting calls that have not begun
     * @param stalls turns that took longer than {@link SpaceSettings#stallLimit}
     * @param busy the time of its turns, by the machine's clock
     * @param longest the longest turn
     * @param current the time that the turn which is running now has taken so far; zero if there is none
     */
    public record Node(
            String space,
            String name,
            long turns,
            long waiting,
            long stalls,
            Duration busy,
            Duration longest,
            Duration current) {}

    /**
     * What one node has sent to another.
     *
     * @param calls messages and requests
     * @param results sent to callbacks that {@code to} had passed as arguments
     */
    public record Edge(Node from, Node to, long calls, long results) {}

    /** The counts at a moment; nodes and edges in the order in which they occurred first. */
    public record Snapshot(List<Node> nodes, List<Edge> edges) {
        public Snapshot {
            nodes = List.copyOf(nodes);
            edges = List.copyOf(edges);
        }
    }

    private final Clock clock;
    private final Map<Key, Counter> counters = new ConcurrentHashMap<>();
    private final List<Counter> inOrder = new ArrayList<>(); // guarded by this
    private final List<Link> links = new ArrayList<>(); // guarded by this

    public CallGraph() {
        this(Clock.system());
    }

    /** @param clock measures turns */
    CallGraph(Clock clock) {
        this.clock = clock;
    }

    /** What has been counted until now. */
    public Snapshot snapshot() {
        long now = clock.nanos();
        Map<Counter, Node> nodes = new IdentityHashMap<>();
        List<Node> ordered = new ArrayList<>();
        List<Edge> edges = new ArrayList<>();
        synchronized (this) {
            for (Counter counter : inOrder) {
                Node node = counter.node(now);
                nodes.put(counter, node);
                ordered.add(node);
            }
            for (Link link : links) {
                edges.add(new Edge(nodes.get(link.from), nodes.get(link.to), link.calls.sum(), link.results.sum()));
            }
        }
        return new Snapshot(ordered, edges);
    }

    /**
     * Counts a message that is no call of an actor, for example one on a bus.
     *
     * @param space that groups the names; it need not be an actor space
     */
    public void note(String space, String from, String to) {
        Counter sender = counter(new Key(space, from));
        counter(new Key(space, to)).from(sender).calls.increment();
    }

    // ---- called by the spaces

    @Override
    public void called(Party from, Party to, Call call) {
        Counter sender = counter(from);
        Counter receiver = counter(to);
        receiver.received.increment();
        receiver.from(sender).calls.increment();
    }

    @Override
    public void begun(Party actor, Call call) {
        counter(actor).taken.increment();
    }

    @Override
    public void dropped(Party actor, Call call) {
        counter(actor).taken.increment();
    }

    @Override
    public void returned(Party from, Party to) {
        Counter sender = counter(from);
        counter(to).from(sender).results.increment();
    }

    @Override
    public Turn turnBegun(Party party, @Nullable Duration stallLimit) {
        Counter counter = counter(party);
        long now = clock.nanos();
        counter.begunNanos.set(now);
        return new CountedTurn(this, counter, now, stallLimit);
    }

    private record CountedTurn(
            CallGraph graph,
            Counter counter,
            long begunNanos,
            @Nullable Duration stallLimit) implements Turn {
        @Override
        public void end() {
            long nanos = graph.clock.nanos() - begunNanos;
            counter.begunNanos.set(Counter.IDLE);
            counter.turns.increment();
            counter.busyNanos.add(nanos);
            counter.longestNanos.accumulateAndGet(nanos, Math::max);
            if (stallLimit != null && nanos > Home.nanosOf(stallLimit)) {
                counter.stalls.increment();
            }
        }
    }

    private Counter counter(Party party) {
        return counter(new Key(party.space(), party.name()));
    }

    private Counter counter(Key key) {
        Counter known = counters.get(key);
        return known == null ? newCounter(key) : known;
    }

    private synchronized Counter newCounter(Key key) {
        boolean isFull = counters.size() >= MOST_NODES && !key.name().equals(OTHERS);
        return isFull
                ? counter(new Key(key.space(), OTHERS))
                : counters.computeIfAbsent(key, each -> {
                    var made = new Counter(this, each);
                    inOrder.add(made);
                    return made;
                });
    }

    private synchronized Link newLink(Counter from, Counter to) {
        return to.senders.computeIfAbsent(from, each -> {
            var made = new Link(from, to);
            links.add(made);
            return made;
        });
    }

    /** What counts as one node: also actors of one name in spaces of one name. */
    private record Key(String space, String name) {}

    private record Link(Counter from, Counter to, LongAdder calls, LongAdder results) {
        Link(Counter from, Counter to) {
            this(from, to, new LongAdder(), new LongAdder());
        }
    }

    /** The counters of a node. Written by its space, and by callers; read by others. */
    private static final class Counter {
        static final long IDLE = Long.MIN_VALUE;

        private final CallGraph graph;
        private final Key key;
        private final Map<Counter, Link> senders = new ConcurrentHashMap<>();
        private final LongAdder received = new LongAdder();
        private final LongAdder taken = new LongAdder();
        private final LongAdder turns = new LongAdder();
        private final LongAdder stalls = new LongAdder();
        private final LongAdder busyNanos = new LongAdder();
        private final AtomicLong longestNanos = new AtomicLong();
        private final AtomicLong begunNanos = new AtomicLong(IDLE); // of the turn that is running

        Counter(CallGraph graph, Key key) {
            this.graph = graph;
            this.key = key;
        }

        Link from(Counter sender) {
            Link known = senders.get(sender);
            return known == null ? graph.newLink(sender, this) : known;
        }

        Node node(long nowNanos) {
            long begun = begunNanos.get();
            long leaving = taken.sum(); // read first: a call arrives before it leaves
            return new Node(
                    key.space(),
                    key.name(),
                    turns.sum(),
                    Math.max(0, received.sum() - leaving),
                    stalls.sum(),
                    Duration.ofNanos(busyNanos.sum()),
                    Duration.ofNanos(longestNanos.get()),
                    begun == IDLE ? Duration.ZERO : Duration.ofNanos(Math.max(0, nowNanos - begun)));
        }
    }
}
