package io.troupe.player;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.PlayerConnection;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.function.LongConsumer;
import org.jspecify.annotations.Nullable;

/**
 * What the server has sent and the client's program has not seen yet, and by which call the program answers.
 *
 * <p><b>Threads.</b> Any thread; one lock. The server hands a frame in under it, the program sees it under it: what the
 * world did before a tick happens before what the program does about it. The tick a program answers is read under the
 * lock by which it found nothing new, and told to the server after that: an answer never covers data the program has
 * not been offered, and all that the program did before happens before the world goes on. No wake-up is lost, since
 * every wait looks at its condition under the lock, and whoever changes one notifies under it.
 *
 * <p><b>Order.</b> Data are dispatched under the lock as well, so frames never mix.
 */
final class Incoming implements DataSink {
    /**
     * How many frames wait for a program that does not read what a server sends on and on; in lock step there is one.
     */
    private static final int MOST_FRAMES = 1024;

    private final Object lock = new Object();
    private final Queue<Frame> frames = new ArrayDeque<>();
    private final List<Deferred<@Nullable Void>> waiting = new ArrayList<>();
    private final AnswerPoint answerPoint = new AnswerPoint();
    private final Consumer<DataMessage> dispatcher;
    private final LongConsumer answer;
    private final boolean onSpace;
    private int read; // messages of the oldest frame that are dispatched already
    private long shownTick = PlayerConnection.NO_TICK;
    private int openRequests;
    private int unreadReply; // type of the newest reply that readAll has not told of; 0 = none
    private @Nullable String lost;

    /**
     * @param dispatcher hands a message to its device
     * @param answer tells the server that the program waits for something newer than a tick
     * @param onSpace true on an actor space, where frames arrive as a turn of their own
     */
    Incoming(Consumer<DataMessage> dispatcher, LongConsumer answer, boolean onSpace) {
        this.dispatcher = dispatcher;
        this.answer = answer;
        this.onSpace = onSpace;
    }

    // ---- from the server

    @Override
    public void frame(Frame frame) {
        List<Deferred<@Nullable Void>> ready = List.of();
        synchronized (lock) {
            if (frames.size() == MOST_FRAMES) {
                frames.remove(); // as a server does whose client is slow, but the oldest: a robot lives now
                read = 0;
            }
            frames.add(frame);
            if (onSpace) {
                ready = showAll();
            }
            lock.notifyAll();
        }
        ready.forEach(each -> each.resolve(null));
    }

    /** A request is about to be sent. */
    void requestBegins() {
        synchronized (lock) {
            openRequests++;
        }
    }

    /** A request could not be sent. */
    void requestFails() {
        synchronized (lock) {
            openRequests--;
        }
    }

    /** A reply has come, which {@code dispatch} hands to its device. */
    void requestEnds(int replyType, Runnable dispatch) {
        synchronized (lock) {
            openRequests--;
            unreadReply = replyType;
            dispatch.run();
            lock.notifyAll();
        }
    }

    @Override
    public void lost(String reason) {
        List<Deferred<@Nullable Void>> ended;
        synchronized (lock) {
            if (lost != null) {
                return;
            }
            lost = reason;
            ended = takeWaiting();
            lock.notifyAll();
        }
        ended.forEach(each -> each.reject(new PlayerException(reason)));
    }

    // ---- from the program

    /**
     * Looks for news in a program that waits by asking; without any it may answer, and then gives the world a moment.
     *
     * @param everythingSeen whether no device has news
     */
    boolean poll(Latest<?> asked, BooleanSupplier everythingSeen, long patienceMillis) {
        long tick;
        synchronized (lock) {
            if (asked.takeNew()) {
                answerPoint.newsTaken();
                return true;
            }
            throwIfLost();
            // On a space a chain of turns may still lie between this question and the end of the work: only asking
            // again is waiting.
            if (!answerPoint.isAt(asked, !onSpace && everythingSeen.getAsBoolean())) {
                return false;
            }
            tick = shownTick;
        }
        answer.accept(tick);
        return !onSpace && awaitFrame(asked, patienceMillis);
    }

    private boolean awaitFrame(Latest<?> asked, long patienceMillis) {
        List<Deferred<@Nullable Void>> ready;
        boolean news;
        synchronized (lock) {
            if (frames.isEmpty() && lost == null) {
                pause(patienceMillis);
            }
            if (frames.isEmpty()) {
                throwIfLost();
            }
            ready = showAll();
            news = asked.takeNew();
        }
        ready.forEach(each -> each.resolve(null));
        return news;
    }

    /** Looks for news in a program that reads by itself: asking is not waiting there. */
    boolean takeNew(Latest<?> asked) {
        synchronized (lock) {
            if (asked.takeNew()) {
                return true;
            }
            throwIfLost();
            return false;
        }
    }

    /**
     * Looks whether a reply has come; while one is on its way, that may take a moment, as busy loops wait for replies
     * too.
     */
    boolean takeReply(Latest<?> asked, long patienceMillis) {
        synchronized (lock) {
            if (!asked.isNew() && openRequests > 0 && lost == null) {
                pause(patienceMillis);
            }
            if (asked.takeNew()) {
                return true;
            }
            throwIfLost();
            return false;
        }
    }

    /**
     * Dispatches the oldest message, or with {@code wholeFrame} whatever is there; without any it answers and waits. A
     * reply that nobody has waited for is a message too, if it is the only one there, so that a program which reads
     * until its reply has come does not wait for data.
     *
     * @return the type of the message
     */
    int read(boolean wholeFrame) {
        long tick;
        boolean wait;
        synchronized (lock) {
            wait = !hasMessage() && (wholeFrame || unreadReply == 0);
            tick = shownTick;
        }
        if (wait) {
            answer.accept(tick);
        }
        List<Deferred<@Nullable Void>> ready;
        synchronized (lock) {
            // a whole frame may be empty, and the server waits for the answer to it
            while (!hasMessage() && !(wholeFrame && shownTick > tick)) {
                if (!wholeFrame && unreadReply != 0) {
                    int type = unreadReply;
                    unreadReply = 0;
                    return type;
                }
                throwIfLost();
                await();
            }
            for (boolean more = hasMessage(); more; more = wholeFrame && hasMessage()) {
                dispatchOldest();
            }
            unreadReply = 0;
            ready = read == 0 ? takeWaiting() : List.of();
        }
        ready.forEach(each -> each.resolve(null));
        return wholeFrame ? PlayerConstants.PLAYER_MSGTYPE_SYNCH : PlayerConstants.PLAYER_MSGTYPE_DATA;
    }

    /** The program waits for its first data, if it has not got them already. */
    void begin() {
        synchronized (lock) {
            throwIfLost();
            if (shownTick != PlayerConnection.NO_TICK) {
                return;
            }
        }
        answer.accept(PlayerConnection.NO_TICK);
    }

    /** Fulfilled with the next complete frame. Off actor spaces, asking for it is waiting. */
    Promise<@Nullable Void> next() {
        var next = new Deferred<@Nullable Void>();
        long tick;
        synchronized (lock) {
            if (lost != null) {
                next.reject(new PlayerException(lost));
                return next;
            }
            waiting.add(next);
            tick = shownTick;
            lock.notifyAll();
        }
        if (!onSpace || tick == PlayerConnection.NO_TICK) {
            answer.accept(tick);
        }
        return next;
    }

    // ---- from the reader thread

    /**
     * Shows frames to a program that does not meet them by asking: because it has not asked yet, waits for a promise,
     * or does not ask any more while the server sends on.
     *
     * @throws PlayerException when the server has gone
     */
    void showWhile(BooleanSupplier goOn) {
        while (true) {
            List<Deferred<@Nullable Void>> ready;
            synchronized (lock) {
                while (goOn.getAsBoolean() && !isForReader()) {
                    throwIfLost();
                    await();
                }
                if (!goOn.getAsBoolean()) {
                    return;
                }
                ready = showAll();
            }
            ready.forEach(each -> each.resolve(null));
        }
    }

    private boolean isForReader() {
        return !frames.isEmpty() && (!answerPoint.isReached() || !waiting.isEmpty() || frames.size() > 1);
    }

    /** Lets whoever waits look again. */
    void wakeAll() {
        synchronized (lock) {
            lock.notifyAll();
        }
    }

    // ---- under the lock

    private List<Deferred<@Nullable Void>> showAll() {
        if (frames.isEmpty()) {
            return List.of();
        }
        while (!frames.isEmpty()) {
            while (read < frames.element().messages().size()) {
                dispatcher.accept(frames.element().messages().get(read++));
            }
            completeFrame();
        }
        return takeWaiting();
    }

    /** Whether a message is there; a frame without any is complete as it is. */
    private boolean hasMessage() {
        while (!frames.isEmpty() && frames.element().messages().isEmpty()) {
            completeFrame();
        }
        return !frames.isEmpty();
    }

    private void dispatchOldest() {
        var messages = frames.element().messages();
        dispatcher.accept(messages.get(read++));
        if (read == messages.size()) {
            completeFrame();
        }
    }

    private void completeFrame() {
        shownTick = frames.remove().tick();
        read = 0;
        answerPoint.frameShown();
    }

    private List<Deferred<@Nullable Void>> takeWaiting() {
        var taken = List.copyOf(waiting);
        waiting.clear();
        return taken;
    }

    private void throwIfLost() {
        if (lost != null) {
            throw new PlayerException(lost);
        }
    }

    private void pause(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt(); // for the program to see; the call does not block
        }
    }

    private void await() {
        try {
            lock.wait();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new PlayerException("interrupted while waiting for the Player server", e);
        }
    }
}
