package io.troupe.bus;

import io.troupe.bus.BusMessage.Purpose;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.ObjLongConsumer;
import org.jspecify.annotations.Nullable;

/**
 * Makes the age of the first frames of a node known before they are handled.
 *
 * <p>The age of a frame is how much longer it took than the fastest frame of its node. If the first frames of a node
 * were all held up, by a cut or because this process did not run, the first one would look fast. So the first frame
 * whose age matters is held, with all that follow it, until a request to its node has been answered: the reply was sent
 * after the request, so it is no older than the two took together. That also shows when the node was opened and when
 * its series began, and so whether values that it published before are missing here.
 *
 * <p><b>Threads.</b> Any thread. <b>Order.</b> Held frames are handled in their order, before later ones of their kind:
 * publications, or all others.
 */
final class FirstContacts {
    /**
     * The receiver of the request, on every node. Nodes that do not know it reject the request, which serves as well.
     */
    static final String PORT = "$bus";

    static final String OPERATION = "time";
    static final Nothing NOTHING = new Nothing();

    /** Measures well enough; one that is slower is accepted after a few attempts. */
    private static final long FAST_NANOS = 100_000_000;

    private static final int MOST_SLOW_ANSWERS = 3;
    private static final Duration RETRY = Duration.ofMillis(500);
    private static final int MOST_ATTEMPTS = 6;
    private static final int MOST_HELD = 1_000; // of one node
    private static final int MOST_LIVES = 10_000;

    /** One life of another node. Frames of the one before may arrive later than its first, on another thread. */
    private record Life(String node, long incarnation) {}

    /** The value of the request and of its reply. */
    record Nothing() {}

    private final Bus bus;
    private final RemotePublishers publishers;
    private final ObjLongConsumer<String> ask;
    private final Map<Life, Contact> contacts = new ConcurrentHashMap<>();
    private final Map<Long, Contact> asked = new ConcurrentHashMap<>(); // by the number of the last request

    /** @param ask sends the request to a node, with a number; it may throw if there is no connection */
    FirstContacts(Bus bus, RemotePublishers publishers, ObjLongConsumer<String> ask) {
        this.bus = bus;
        this.publishers = publishers;
        this.ask = ask;
    }

    static boolean isTime(Purpose.Request request) {
        return request.to().name().equals(PORT) && request.operation().equals(OPERATION);
    }

    /**
     * Holds a frame, if ages of its node are not known yet and matter.
     *
     * @param handling handles it later
     * @return false if it is to be handled now
     */
    boolean hold(Frames.Frame frame, Runnable handling) {
        var header = frame.header();
        if (frame.body() instanceof Frames.Body.Replied || frame.body() instanceof Frames.Body.Rejected) {
            return false;
        }
        var life = new Life(header.from().node(), header.incarnation());
        Contact known = contacts.get(life);
        if (known != null) {
            return known.hold(frame, handling);
        }
        if (!needsAge(frame)) {
            return false;
        }
        if (contacts.size() >= MOST_LIVES) {
            contacts.clear(); // names are cheap to invent: memory must not grow with them
        }
        var contact = new Contact(life);
        Contact faster = contacts.putIfAbsent(life, contact); // of another thread
        if (faster != null) {
            return faster.hold(frame, handling);
        }
        contact.hold(frame, handling);
        ask(contact);
        return true;
    }

    private boolean needsAge(Frames.Frame frame) {
        return switch (frame.body()) {
            case Frames.Body.Published(var publication, long series, long ageMicros) ->
                bus.agesMatter(publication.topic()) || isLateFirst(frame, publication, series - 1);
            case Frames.Body.Mark(var publication, long series, var begunMicros) ->
                isLateFirst(frame, publication, series);
            case Frames.Body.Requested requested -> requested.limitMicros() != 0;
            default -> false;
        };
    }

    /** Values before it may have been lost: it depends on when the publisher began, by this node's clock. */
    private boolean isLateFirst(Frames.Frame frame, Purpose.Publication publication, long before) {
        return before > 0 && publishers.isFirst(frame.header(), publication.topic());
    }

    private void ask(Contact contact) {
        long number = bus.nextNumber();
        asked.remove(contact.number);
        contact.asked(number, bus.nanos());
        asked.put(number, contact);
        bus.settings.space().delay(RETRY).then((nothing, closed) -> {
            if (closed == null && asked.remove(number, contact)) {
                unanswered(contact);
            }
        });
        try {
            ask.accept(contact.life.node, number);
        } catch (RuntimeException disconnected) {
            return; // it is asked again
        }
    }

    private void unanswered(Contact contact) {
        if (contact.attempts < MOST_ATTEMPTS) {
            ask(contact);
        } else {
            contacts.remove(contact.life, contact);
            int lost = contact.giveUp();
            bus.notifier.lost(new Loss.LostOnTheWay(
                    lost, "node " + contact.life.node + " does not answer how old its messages are"));
        }
    }

    /** Returns whether that number is that of a request for the time. */
    boolean isAsked(long number) {
        return asked.containsKey(number);
    }

    /** A reply has arrived; returns whether it is one to a request for the time. Its age is known already. */
    boolean answered(Frames.Header header, long request) {
        Contact contact = asked.get(request);
        if (contact == null) {
            return false;
        }
        if (header.incarnation() == contact.life.incarnation && asked.remove(request, contact)) {
            boolean isFast = bus.nanos() - contact.askedNanos <= FAST_NANOS;
            if (isFast || contact.attempts >= MOST_SLOW_ANSWERS) {
                release(contact);
            } else {
                ask(contact);
            }
        }
        return true; // or it is that of another life: this one does not answer any more
    }

    private void release(Contact contact) {
        int tooMany = contact.release();
        if (tooMany > 0) {
            bus.notifier.lost(new Loss.LostOnTheWay(
                    tooMany, "node " + contact.life.node + " sent too much before its clock was known"));
        }
    }

    /** What is held of a node's life. */
    private static final class Contact {
        final Life life;
        private volatile int attempts; // written by one thread at a time, as the next two
        private volatile long number;
        private volatile long askedNanos;
        private final HeldFrames publications = new HeldFrames();
        private final HeldFrames others = new HeldFrames();

        Contact(Life life) {
            this.life = life;
        }

        void asked(long itsNumber, long nowNanos) {
            attempts++;
            number = itsNumber;
            askedNanos = nowNanos;
        }

        boolean hold(Frames.Frame frame, Runnable handling) {
            return switch (frame.body()) {
                case Frames.Body.Published published -> publications.add(handling);
                case Frames.Body.Mark mark -> publications.add(handling);
                default -> others.add(handling);
            };
        }

        /** Handles what is held, and returns how many more there were. */
        int release() {
            publications.handleBeforeAll();
            others.handleAll();
            return publications.tooMany() + others.tooMany();
        }

        /** Returns how many frames are lost. */
        int giveUp() {
            return publications.giveUp() + others.giveUp();
        }
    }

    /**
     * The frames of a node that are held: its publications, or all others. An engine may deliver the two on different
     * threads, so that a flood of publications does not delay the others; nor does it here.
     */
    private static final class HeldFrames {
        private @Nullable ArrayDeque<Runnable> held = new ArrayDeque<>(); // guarded by this; null when released
        private int tooMany; // guarded by this

        /** Returns false if frames are not held any more. */
        synchronized boolean add(Runnable handling) {
            ArrayDeque<Runnable> waiting = held;
            if (waiting == null) {
                return false;
            }
            if (waiting.size() < MOST_HELD) {
                waiting.add(handling);
            } else {
                tooMany++;
            }
            return true;
        }

        /** Handles all. A thread with a later frame waits, and then handles it: this ends, whatever arrives. */
        synchronized void handleBeforeAll() {
            for (Runnable next = next(); next != null; next = next()) {
                next.run();
            }
        }

        /** Handles all; frames that arrive meanwhile are held behind them. No lock is held: a reply may be sent. */
        void handleAll() {
            for (Runnable next = next(); next != null; next = next()) {
                next.run();
            }
        }

        private synchronized @Nullable Runnable next() {
            ArrayDeque<Runnable> waiting = held;
            Runnable next = waiting == null ? null : waiting.poll();
            if (next == null) {
                held = null;
            }
            return next;
        }

        synchronized int tooMany() {
            return tooMany;
        }

        /** Returns how many frames are lost. */
        synchronized int giveUp() {
            ArrayDeque<Runnable> waiting = held;
            held = null;
            return (waiting == null ? 0 : waiting.size()) + tooMany;
        }
    }
}
