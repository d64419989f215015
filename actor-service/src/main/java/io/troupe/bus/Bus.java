package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.loop.Home;
import io.troupe.bus.BusMessage.Failure;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.internal.BoundedText;
import io.troupe.bus.internal.OwnName;
import io.troupe.bus.internal.RecordCopier;
import io.troupe.common.text.Suggestions;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A node of a bus: carries messages between components by publish and subscribe, and by request and reply; within one
 * process, or with an engine between processes.
 *
 * {@snippet :
 * Bus bus = Bus.inProcess("house", BusSettings.on(space));
 * BusPort sensor = bus.attach("sensor");
 * BusPort display = bus.attach("display");
 * display.subscribe(OUTSIDE, (temperature, from) -> show(from + ": " + temperature.celsius()));
 * sensor.publish(OUTSIDE, new Temperature(-3));
 * }
 *
 * <p><b>Role.</b> Opened by {@link #inProcess} or {@link #open}, ended by {@link #close}. No reference crosses the bus:
 * addresses are names, messages are {@link BusMessage} records of values. Lists and maps in a value are copied unless
 * they are immutable, so that users cannot depend on object identity. Kinds of bus differ only in their engine, which
 * sends messages to other nodes.
 *
 * <p><b>Threads.</b> A subscriber or a request handler runs on the actor space, and on behalf of the actor, that
 * registered it; if it was registered outside every space, on the space of the settings. Messages are entries of the
 * callback queue.
 *
 * <p><b>Order.</b> Values of one port reach a subscriber in the order in which they were published. Concurrent calls of
 * {@code publish} on several threads are delivered in either order. At most once: nothing is repeated.
 *
 * <p><b>Cost.</b> Publishing takes one short lock per subscriber. At most {@link BusSettings#capacity} messages are
 * queued for one subscriber; when the queue is full, the oldest is dropped. When the queue of a request handler is
 * full, or it has that many requests begun without a reply, the newest request is rejected instead; requests whose
 * requester on this node has cancelled do not count.
 *
 * <p><b>Errors.</b> {@link BusPort#ask} rejects with a {@link BusException} that names the requester, the receiver and
 * the operation. Causes: no port at the address, no handler for the operation, another value type than expected, too
 * many queued requests, the time limit, or that one of both ports or its space was closed. If an actor stops and its
 * port stays open, the bus detects this at the next message to it. An exception from one subscriber does not affect the
 * others. Methods of a closed port throw a {@link BusException}.
 *
 * <p><b>Source.</b> Paper, sections 2.1.2 and 2.2.3.
 */
public final class Bus implements AutoCloseable {
    /** A longer reason for a rejection is replaced if it cannot be sent. */
    private static final int MOST_OF_A_SHORT_REASON = 400;

    final BusSettings settings;
    final Counters counters = new Counters();
    final ObserverNotifier notifier;
    private final String name;
    private final Clock clock;
    private final long incarnation = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
    private final @Nullable RemoteNodes others; // null for a bus inside one process
    private final LocalPorts localPorts;
    private final PendingRequests pendingRequests = new PendingRequests(this);
    private final RecordCopier copier = new RecordCopier();
    private final AtomicLong numbers = new AtomicLong();
    private final AtomicBoolean closed = new AtomicBoolean();
    private volatile long connectedNanos;
    private volatile boolean connected = true;

    private Bus(String name, BusSettings settings, @Nullable BusEngine engine) {
        this.name = new Address(name, "bus").node(); // validates the name
        this.settings = settings;
        this.clock = settings.space().clock();
        this.connectedNanos = clock.nanos();
        this.notifier = new ObserverNotifier(settings.observer(), counters);
        this.localPorts = new LocalPorts(name);
        this.others = engine == null ? null : new RemoteNodes(this, engine, incarnation);
    }

    /** A bus inside this process that uses {@link ActorSpace#global()} for code outside every actor space. */
    public static Bus inProcess(String node) {
        return inProcess(node, BusSettings.on(ActorSpace.global()));
    }

    /**
     * A bus inside this process.
     *
     * @param node the name of this process in addresses
     */
    public static Bus inProcess(String node, BusSettings settings) {
        return new Bus(node, settings, null);
    }

    /**
     * A bus that also reaches other processes.
     *
     * @param node the name of this process, which no other process on the bus has
     * @param engine carries the messages; it is started now, and closed with the bus
     * @throws BusException if the engine cannot connect, or the name is taken
     */
    public static Bus open(String node, BusEngine engine, BusSettings settings) {
        var bus = new Bus(node, settings, Objects.requireNonNull(engine, "engine"));
        try {
            bus.remote().start();
        } catch (RuntimeException | Error failure) {
            bus.close();
            throw failure;
        }
        return bus;
    }

    private RemoteNodes remote() {
        return Objects.requireNonNull(others);
    }

    /** The name of this process on the bus. */
    public String node() {
        return name;
    }

    /**
     * Attaches a port under a name.
     *
     * @throws IllegalArgumentException if the name is taken, or has a {@code $} or {@code #}, as names of Troupe's own
     *     ports and of numbered services have
     */
    public BusPort attach(String portName) {
        if (portName.indexOf('$') >= 0 || portName.indexOf('#') >= 0) {
            throw new IllegalArgumentException(
                    "the name of a port is \"" + portName + "\", expected a name without $ and #");
        }
        return attach(new OwnName(portName));
    }

    /** @hidden for the parts of Troupe */
    @SuppressWarnings("exports")
    public BusPort attach(OwnName own) {
        String portName = own.name();
        var port = new BusPort(this, new Address(name, portName));
        localPorts.add(port);
        if (closed.get()) {
            port.close("the bus " + name + " is closed");
            throw new BusException(port + " cannot be attached: the bus " + name + " is closed");
        }
        return port;
    }

    /** Closes all ports; pending requests are rejected. */
    @Override
    public void close() {
        if (closed.compareAndSet(false, true)) {
            localPorts.ports().forEach(port -> port.close("the bus " + name + " is closed"));
            if (others != null) {
                others.close();
            }
        }
    }

    /**
     * How long this node has been connected to the others without a break, by the clock of its space: zero while it is
     * disconnected, the time since it was opened if the connection has never broken or if it has no engine. Soon after
     * a break, other nodes may be missing because they are not connected again yet.
     */
    public Duration connectedFor() {
        long since = connectedNanos; // read first: a break in between counts
        return connected ? Duration.ofNanos(clock.nanos() - since) : Duration.ZERO;
    }

    /** The connection to other nodes has begun or ended. */
    void setConnected(boolean is) {
        if (is) {
            connectedNanos = clock.nanos();
        }
        connected = is;
    }

    /** The message counts since the bus was opened. */
    public BusMetrics metrics() {
        return counters.now();
    }

    // ---- called by ports

    void use(BusTopic<?> topic) {
        localPorts.use(topic);
    }

    void release(BusPort port, BusTopic<?> topic) {
        localPorts.release(topic);
        if (others != null) {
            others.endSeries(port.address(), topic.name());
        }
    }

    void add(TopicSubscription<?> subscription) {
        localPorts.add(subscription, topic -> {
            if (others != null) {
                others.subscribe(topic);
            }
        });
    }

    void remove(TopicSubscription<?> subscription) {
        localPorts.remove(subscription, topic -> {
            if (others != null) {
                others.unsubscribe(topic);
            }
        });
    }

    void detach(BusPort port) {
        localPorts.remove(port);
    }

    /** @param ageNanos how old the value is already, because it is forwarded */
    void publish(BusPort from, BusTopic<?> topic, Record payload, long ageNanos) {
        counters.published.increment();
        var message = new BusMessage.Data(from.address(), new Purpose.Publication(topic.name()), nextNumber(), payload);
        notifier.passed(message);
        long nowNanos = topic.maxAge() != null || agesMatter(topic.name()) ? nanos() : MessageDelivery.NOT_NOTED;
        deliver(new MessageDelivery(message, incarnation, nowNanos, ageNanos, Long.MAX_VALUE));
        if (others != null) {
            try {
                others.publish(message, topic.name(), ageNanos);
            } catch (RuntimeException | Error failure) {
                notifier.undeliverable(message, noWayTo("the others", failure));
            }
        }
    }

    /** @param isShared true if the requests that the handler sends share the limit */
    void request(BusMessage message, @Nullable Duration limit, boolean isShared) {
        notifier.passed(message);
        var request = (Purpose.Request) message.purpose();
        if (isShared && request.to().node().equals(name)) {
            deliver(new MessageDelivery(message, incarnation, nanos(), 0, nanosOf(limit), true));
            return;
        }
        send(message, request.to(), nodes -> nodes.request(message, request, limit, isShared));
    }

    private static long nanosOf(@Nullable Duration limit) {
        return limit == null ? Long.MAX_VALUE : Home.nanosOf(limit);
    }

    void notice(BusPort from, Address to, Operation<?, ?> operation, Record payload) {
        var notice = new Purpose.Notice(to, operation.name());
        var message = BusMessage.of(operation.kind(), from.address(), notice, nextNumber(), payload);
        notifier.passed(message);
        send(message, to, nodes -> nodes.notice(message, notice));
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            BusPort requester, Address to, Operation<Q, A> operation, Q request, @Nullable Duration limit) {
        return pendingRequests.ask(requester, to, operation, request, limit);
    }

    void rejectRequestsOf(BusPort requester, String why) {
        pendingRequests.rejectAllOf(requester, why);
    }

    long nextNumber() {
        return numbers.incrementAndGet();
    }

    /** A copy of the value that shares no mutable object with it, as if it had been sent to another process. */
    Record copy(Record value) {
        return copier.copy(value);
    }

    /** The time on the clock of the settings' space. */
    long nanos() {
        return clock.nanos();
    }

    boolean isClosed() {
        return closed.get();
    }

    /** The requester does not wait for the reply any more. */
    void requestCancelled(BusMessage message) {
        var request = (Purpose.Request) message.purpose();
        if (request.to().node().equals(name)) {
            cancel(request, within(message, false).id());
        } else if (others != null) {
            try {
                others.cancel(message, request);
            } catch (RuntimeException | Error notSent) {
                return; // the request ends with its limit there
            }
        }
    }

    /** Cancels a request to a handler on this node. */
    void cancel(Purpose.Request request, MessageDelivery.RequestId id) {
        OperationHandler<?, ?> handler = handler(request.to(), request.operation());
        if (handler != null) {
            handler.cancel(id);
        }
    }

    /** That life of another node has ended: its requests are not awaited any more. */
    void forgetRequestsOf(String node, long itsIncarnation) {
        localPorts.ports().forEach(port -> port.forgetRequestsOf(node, itsIncarnation));
    }

    /** The reply to a request cannot be read. */
    void rejectRequest(long number, String why) {
        pendingRequests.reject(number, why, true);
    }

    /** The node that was asked does not exist now. */
    void rejectUnreachable(long number, String why) {
        BusMessage request = pendingRequests.rejectUnreachable(number, why);
        if (request != null) {
            notifier.undeliverable(request, why);
        }
    }

    /** No request from here gets to that node now. */
    void rejectUnreachable(String node, String why) {
        pendingRequests.numbersTo(node).forEach(number -> rejectUnreachable(number, why));
    }

    /** The type of the topic's values, or null if this node does not subscribe to it. */
    @Nullable
    Class<?> subscribedType(String topic) {
        var subscriptions = localPorts.subscriptions(topic);
        return subscriptions.isEmpty() ? null : subscriptions.getFirst().topic.type();
    }

    /** Returns whether a subscriber of this node drops or forwards values of the topic by their ages. */
    boolean agesMatter(String topic) {
        for (TopicSubscription<?> each : localPorts.subscriptions(topic)) {
            if (each.agesMatter()) {
                return true;
            }
        }
        return false;
    }

    /** The type of an operation's requests, or null if no handler is at that address. */
    @Nullable
    Class<?> requestType(Address to, String operation) {
        OperationHandler<?, ?> handler = handler(to, operation);
        return handler == null ? null : handler.operation.request();
    }

    @Nullable
    Class<?> replyType(long request) {
        return pendingRequests.replyType(request);
    }

    private @Nullable OperationHandler<?, ?> handler(Address to, String operation) {
        BusPort port = localPorts.port(to.name());
        return port == null ? null : port.operationHandler(operation);
    }

    /**
     * Returns whether the requester still waits for the reply. True for every requester on another node, because its
     * state is not known here.
     */
    boolean isAwaited(MessageDelivery request) {
        return isFromAnother(request) || pendingRequests.isAwaited(request.message());
    }

    /** Returns whether the message was sent by another node. */
    boolean isFromAnother(MessageDelivery delivery) {
        return !delivery.message().from().node().equals(name);
    }

    // ---- messages

    /** Sends a reply or a rejection of this node. */
    void route(BusMessage message, long toIncarnation) {
        notifier.passed(message);
        switch (message.purpose()) {
            case Purpose.Reply reply ->
                send(message, reply.to(), nodes -> nodes.reply(message, reply, toIncarnation), toIncarnation);
            case Purpose.Rejection rejection ->
                send(message, rejection.to(), nodes -> nodes.reject(message, rejection, toIncarnation), toIncarnation);
            default -> throw new IllegalStateException("not a reply: " + message);
        }
    }

    private void send(BusMessage message, Address to, Consumer<RemoteNodes> sending) {
        send(message, to, sending, incarnation);
    }

    private void send(BusMessage message, Address to, Consumer<RemoteNodes> sending, long toIncarnation) {
        if (to.node().equals(name)) {
            deliver(within(message, false));
        } else if (others == null) {
            cannotSend(message, "there is no way from node " + name + " to node " + to.node(), toIncarnation);
        } else {
            try {
                sending.accept(others);
            } catch (RuntimeException | Error failure) {
                cannotSend(message, noWayTo("node " + to.node(), failure), toIncarnation);
            }
        }
    }

    private String noWayTo(String others, Throwable failure) {
        return "the way from node " + name + " to " + others + " failed: "
                + (failure instanceof IllegalStateException disconnected
                        ? BoundedText.ofMessage(disconnected)
                        : BoundedText.of(failure));
    }

    private void cannotSend(BusMessage message, String why, long toIncarnation) {
        notifier.undeliverable(message, why);
        pendingRequests.rejectUnreachable(message.sequence(), why); // does nothing if the message is no request
        if (message.purpose() instanceof Purpose.Reply reply) { // a rejection is small and may be sent successfully
            var purpose = new Purpose.Rejection(reply.to(), reply.operation(), reply.request());
            var failure = new Failure.Unanswered("the answer could not be sent: " + why);
            route(BusMessage.of(message.kind(), message.from(), purpose, nextNumber(), failure), toIncarnation);
        } else if (message.purpose() instanceof Purpose.Rejection rejection
                && message.payload() instanceof Failure failure
                && lengthOf(failure) > MOST_OF_A_SHORT_REASON) {
            String shorter = BoundedText.of("the reason could not be sent: " + why, MOST_OF_A_SHORT_REASON / 2);
            var again = failure instanceof Failure.NotDelivered
                    ? new Failure.NotDelivered(shorter)
                    : new Failure.Unanswered(shorter);
            route(BusMessage.of(message.kind(), message.from(), rejection, nextNumber(), again), toIncarnation);
        }
    }

    private static int lengthOf(Failure failure) {
        return switch (failure) {
            case Failure.NotDelivered(String why) -> why.length();
            case Failure.Unanswered(String why) -> why.length();
            case Failure.Failed(String type, String text) -> type.length() + text.length();
        };
    }

    private MessageDelivery within(BusMessage message, boolean timed) {
        return MessageDelivery.within(message, incarnation, timed ? nanos() : MessageDelivery.NOT_NOTED);
    }

    /** A message from another node has arrived. */
    void receive(MessageDelivery delivery) {
        notifier.passed(delivery.message());
        deliver(delivery);
    }

    private void deliver(MessageDelivery delivery) {
        BusMessage message = delivery.message();
        switch (message.purpose()) {
            case Purpose.Publication publication -> deliverToAll(delivery, publication.topic());
            case Purpose.Request request -> deliverTo(request.to(), request.operation(), delivery);
            case Purpose.Notice notice -> deliverTo(notice.to(), notice.operation(), delivery);
            case Purpose.Reply reply -> pendingRequests.settle(message, reply.request());
            case Purpose.Rejection rejection -> pendingRequests.settle(message, rejection.request());
        }
    }

    private void deliverToAll(MessageDelivery delivery, String topic) {
        BusMessage message = delivery.message();
        for (TopicSubscription<?> subscription : localPorts.subscriptions(topic)) {
            if (subscription.topic.type().isInstance(message.payload())) {
                subscription.offer(delivery); // a subscription that has just ended ignores it
            } else {
                notifier.undeliverable(
                        message,
                        "it is a " + message.payload().getClass().getName() + ", and " + subscription.port
                                + " expects a " + subscription.topic.type().getName());
            }
        }
    }

    private void deliverTo(Address to, String operation, MessageDelivery delivery) {
        BusPort port = localPorts.port(to.name());
        if (port == null) {
            reject(to, delivery, "there is no such port; " + localPorts.hint(to.name()));
            return;
        }
        OperationHandler<?, ?> handler = port.operationHandler(operation);
        if (handler == null) {
            reject(to, delivery, "it does not answer that; " + Suggestions.hint(operation, port.operations()));
            return;
        }
        Record payload = delivery.message().payload();
        if (!handler.operation.request().isInstance(payload)) {
            reject(
                    to,
                    delivery,
                    "the request is a " + payload.getClass().getName() + ", expected a "
                            + handler.operation.request().getName());
            return;
        }
        String ended = handler.offer(delivery);
        if (ended != null) {
            reject(to, delivery, "it does not answer any more: " + ended);
        }
    }

    /** Rejects a request, or reports a one-way message, that is not delivered to a handler. */
    void reject(Address receiver, MessageDelivery request, String why) {
        reject(receiver, request, why, new Failure.NotDelivered(why));
    }

    /** Rejects a request that was delivered, and to which no reply will come. */
    void leaveUnanswered(Address receiver, MessageDelivery request, String why) {
        reject(receiver, request, why, new Failure.Unanswered(why));
    }

    private void reject(Address receiver, MessageDelivery request, String why, Record failure) {
        notifier.undeliverable(request.message(), why);
        if (request.message().purpose() instanceof Purpose.Request) {
            route(rejection(receiver, request, failure), request.incarnation());
        }
    }

    BusMessage rejection(Address receiver, MessageDelivery delivery, Record failure) {
        BusMessage request = delivery.message();
        var purpose = new Purpose.Rejection(request.from(), operationOf(request), request.sequence());
        return BusMessage.of(request.kind(), receiver, purpose, nextNumber(), failure);
    }

    BusMessage reply(Address receiver, MessageDelivery delivery, Record reply) {
        BusMessage request = delivery.message();
        var purpose = new Purpose.Reply(request.from(), operationOf(request), request.sequence());
        return BusMessage.of(request.kind(), receiver, purpose, nextNumber(), reply);
    }

    private static String operationOf(BusMessage message) {
        if (message.purpose() instanceof Purpose.Request request) {
            return request.operation();
        }
        throw new IllegalStateException("not a request: " + message);
    }

    @Override
    public String toString() {
        return "bus " + name;
    }

    /** Notifies the observer of a node, and counts losses. */
    static final class ObserverNotifier {
        private final BusObserver observer;
        private final Counters counters;

        ObserverNotifier(BusObserver observer, Counters counters) {
            this.observer = observer;
            this.counters = counters;
        }

        void passed(BusMessage message) {
            notifyObserver(each -> each.passed(message));
        }

        void undeliverable(BusMessage message, String why) {
            counters.undeliverable.increment();
            lost(new Loss.Undeliverable(message, why));
        }

        void unreadable(String what, RuntimeException why) {
            counters.unreadable.increment();
            lost(new Loss.Unreadable(what, String.valueOf(why.getMessage())));
        }

        void disconnected(String why) {
            notifyObserver(each -> each.disconnected(why));
        }

        void connected() {
            notifyObserver(BusObserver::connected);
        }

        void late(BusMessage reply, String why) {
            counters.late.increment();
            lost(new Loss.Late(reply, why));
        }

        /** Reports a loss that its caller counts. */
        void lost(Loss loss) {
            notifyObserver(each -> each.lost(loss));
        }

        void handlerFailed(BusMessage request, Throwable error) {
            notifyObserver(each -> each.failed(request, error));
        }

        private void notifyObserver(Consumer<BusObserver> event) {
            try {
                event.accept(observer);
            } catch (RuntimeException | Error failure) { // an observer's exception must not end a delivery
                LoggingObserver.observerFailed(failure);
            }
        }
    }
}
