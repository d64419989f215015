package io.troupe.player;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.PlayerConnection;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Queue;
import java.util.Set;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.function.LongConsumer;
import org.jspecify.annotations.Nullable;

/**
 * A client's inbox: frames that the server has sent and the program has not seen, and the calls by which the program
 * answers a tick.
 *
 * <p><b>Threads.</b> Any thread; one lock. The server adds frames and the program reads them under this lock, so
 * everything the world did before a tick happens-before the program's reaction to it. The tick to answer is read under
 * the same lock in which no new data were found, and is sent to the server after the lock is released. An answer
 * therefore never covers data that the program could not see yet, and everything the program did before the answer
 * happens-before the world's next step. No wake-up is lost: each wait checks its condition under the lock, and each
 * change of a condition notifies under the lock.
 *
 * <p><b>Order.</b> Data are dispatched under the lock too, so frames never mix.
 */
final class ClientInbox implements DataSink {
    /**
     * Bound of queued frames, for a program that stops reading while the server keeps sending; in lock step there is
     * one.
     */
    private static final int MAX_FRAMES = 1024;

    private final Object lock = new Object();
    private final Queue<Frame> frames = new ArrayDeque<>();
    private final List<Deferred<@Nullable Void>> waiting = new ArrayList<>();
    private final IdlePollDetector idlePolls = new IdlePollDetector();
    private final Consumer<DeviceDataMessage> dispatcher;
    private final LongConsumer answer;
    private final boolean onSpace;
    private int dispatched; // number of messages of the oldest frame already dispatched
    private long shownTick = PlayerConnection.NO_TICK;
    private int openRequests;
    private int unreadReply; // type of the newest reply that readAll has not returned yet; 0 = none
    private @Nullable String lost;

    /**
     * @param dispatcher passes a message to its device
     * @param answer notifies the server that the program waits for data newer than a tick
     * @param onSpace true on an actor space, where each frame arrives in a separate turn
     */
    ClientInbox(Consumer<DeviceDataMessage> dispatcher, LongConsumer answer, boolean onSpace) {
        this.dispatcher = dispatcher;
        this.answer = answer;
        this.onSpace = onSpace;
    }

    // ---- called by the server

    @Override
    public void frame(Frame frame) {
        List<Deferred<@Nullable Void>> ready = List.of();
        synchronized (lock) {
            if (frames.size() == MAX_FRAMES) {
                frames.remove(); // drop the oldest frame: a robot needs the latest data
                dispatched = 0;
            }
            frames.add(frame);
            if (onSpace) {
                ready = showAll();
            }
            lock.notifyAll();
        }
        ready.forEach(each -> each.resolve(null));
    }

    /** Counts a request that is about to be sent. */
    void requestBegins() {
        synchronized (lock) {
            openRequests++;
        }
    }

    /** Takes back {@link #requestBegins}: the request could not be sent. */
    void requestFails() {
        synchronized (lock) {
            openRequests--;
        }
    }

    /** Handles a reply; {@code dispatch} passes it to its device. */
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

    // ---- called by the program

    /**
     * Polls for new data in a program that waits by polling. If there are none and the call counts as waiting, it
     * answers the tick and then waits briefly for the next frame.
     *
     * @param everythingSeen true if no device has unread data
     */
    boolean poll(LatestValue<?> polled, BooleanSupplier everythingSeen, long patienceMillis) {
        long tick;
        synchronized (lock) {
            if (polled.takeNew()) {
                idlePolls.dataRead();
                return true;
            }
            throwIfLost();
            // On a space the polling turn may have queued further turns, so only a repeated poll counts as waiting.
            if (!idlePolls.isWaiting(polled, !onSpace && everythingSeen.getAsBoolean())) {
                return false;
            }
            tick = shownTick;
        }
        answer.accept(tick);
        return !onSpace && awaitFrame(polled, patienceMillis);
    }

    private boolean awaitFrame(LatestValue<?> polled, long patienceMillis) {
        List<Deferred<@Nullable Void>> ready;
        boolean newData;
        synchronized (lock) {
            if (frames.isEmpty() && lost == null) {
                pause(patienceMillis);
            }
            if (frames.isEmpty()) {
                throwIfLost();
            }
            ready = showAll();
            newData = polled.takeNew();
        }
        ready.forEach(each -> each.resolve(null));
        return newData;
    }

    /** Polls for new data in a program that calls readAll; there an unsuccessful poll does not answer the tick. */
    boolean takeNew(LatestValue<?> polled) {
        synchronized (lock) {
            if (polled.takeNew()) {
                return true;
            }
            throwIfLost();
            return false;
        }
    }

    /**
     * Polls for a reply. While a request is open this waits briefly, because programs also wait for replies in busy
     * loops.
     */
    boolean takeReply(LatestValue<?> polled, long patienceMillis) {
        synchronized (lock) {
            if (!polled.isNew() && openRequests > 0 && lost == null) {
                pause(patienceMillis);
            }
            if (polled.takeNew()) {
                return true;
            }
            throwIfLost();
            return false;
        }
    }

    /**
     * Dispatches the oldest message, or with {@code wholeFrame} all queued messages. With none queued it answers the
     * tick and waits. A reply counts as a message if nothing else is queued, so a program that reads until its reply
     * has arrived does not wait for data.
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
            // a whole frame may be empty; the server waits for its answer too
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
            ready = dispatched == 0 ? takeWaiting() : List.of();
        }
        ready.forEach(each -> each.resolve(null));
        return wholeFrame ? PlayerConstants.PLAYER_MSGTYPE_SYNCH : PlayerConstants.PLAYER_MSGTYPE_DATA;
    }

    /** Answers as waiting for the first data, unless they have arrived already. */
    void begin() {
        synchronized (lock) {
            throwIfLost();
            if (shownTick != PlayerConnection.NO_TICK) {
                return;
            }
        }
        answer.accept(PlayerConnection.NO_TICK);
    }

    /** Completes with the next complete frame. Outside actor spaces this call answers the tick. */
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

    // ---- called by the reader thread

    /**
     * Makes frames visible to a program that does not poll for them: it has not polled yet, it waits for a promise, or
     * it has stopped polling while the server keeps sending.
     *
     * @throws PlayerException if the connection to the server is lost
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
        return !frames.isEmpty() && (!idlePolls.hasWaited() || !waiting.isEmpty() || frames.size() > 1);
    }

    /** Wakes all waiting threads, which check their conditions again. */
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
            while (dispatched < frames.element().messages().size()) {
                dispatcher.accept(frames.element().messages().get(dispatched++));
            }
            completeFrame();
        }
        return takeWaiting();
    }

    /** True if a message is queued; empty frames at the head are completed. */
    private boolean hasMessage() {
        while (!frames.isEmpty() && frames.element().messages().isEmpty()) {
            completeFrame();
        }
        return !frames.isEmpty();
    }

    private void dispatchOldest() {
        var messages = frames.element().messages();
        dispatcher.accept(messages.get(dispatched++));
        if (dispatched == messages.size()) {
            completeFrame();
        }
    }

    private void completeFrame() {
        shownTick = frames.remove().tick();
        dispatched = 0;
        idlePolls.frameShown();
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
            Thread.currentThread().interrupt(); // left for the program: this call does not block
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

    /**
     * Decides which unsuccessful {@code isDataReady()} call counts as the program waiting for the next frame.
     *
     * <p>An unsuccessful call alone is not enough. In {@code if (pos.isDataReady()) ..; if (son.isDataReady()) ..} the
     * position poll may return false although unread sonar data follow. The program waits in a call if it has already
     * seen all data, or if it polls the same device unsuccessfully for the second time. That device stays the waiting
     * point until the next frame, and the next frame becomes visible only in a call for that device. So the place in a
     * program's loop where new data appear does not depend on the speed of any thread. If the program later polls
     * another device unsuccessfully twice, and no longer the waiting point, that device becomes the waiting point.
     *
     * <p><b>Threads.</b> Not thread-safe; guarded by the lock of {@link ClientInbox}.
     */
    private static final class IdlePollDetector {
        private final Set<Object> unsuccessfulPolls = Collections.newSetFromMap(new IdentityHashMap<>());
        private @Nullable Object waitingPoint;

        /** True if the program waits in this unsuccessful call. */
        boolean isWaiting(Object polled, boolean everythingSeen) {
            boolean waits =
                    polled == waitingPoint || waitingPoint == null && everythingSeen || !unsuccessfulPolls.add(polled);
            if (waits) {
                waitingPoint = polled;
                unsuccessfulPolls.clear();
            }
            return waits;
        }

        /** True if the program has waited since the newest frame. */
        boolean hasWaited() {
            return waitingPoint != null;
        }

        /** The program has read new data. */
        void dataRead() {
            unsuccessfulPolls.clear();
        }

        /** A frame has become visible. */
        void frameShown() {
            waitingPoint = null;
            unsuccessfulPolls.clear();
        }
    }
}
