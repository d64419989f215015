package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.BusMessage.Failure;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.common.text.Suggestions;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;

/**
 * The bus of one process: carries messages between components by publish and subscribe, and by request and reply.
 *
 * {@snippet :
 * Bus bus = Bus.inProcess("house", BusSettings.on(space));
 * BusPort sensor = bus.attach("sensor");
 * BusPort display = bus.attach("display");
 * display.subscribe(OUTSIDE, (temperature, from) -> show(from + ": " + temperature.celsius()));
 * sensor.publish(OUTSIDE, new Temperature(-3));
 * }
 *
 * <p><b>Role.</b> Opened by {@link #inProcess}, ended by {@link #close}. No reference crosses the bus: addresses are
 * names, messages are {@link BusMessage} records of values. Lists and maps in a value are copied unless they are
 * immutable, so that users cannot depend on object identity. Kinds of bus differ only in how they send messages to
 * other nodes.
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
    /**
     * Sends messages to other nodes; the only part in which kinds of bus differ. Passes incoming messages to
     * {@link #receive}.
     *
     * <p><b>Role.</b> A node that is opened again under the same name numbers its messages from 1 again. A transport
     * must not deliver to it messages that were sent to, or by, the earlier node of that name. One way is to put the
     * incarnation of each node into its frames.
     *
     * <p><b>Threads.</b> Called from any thread; must not block. <b>Order.</b> Messages of one sender to one node
     * arrive in the order in which they were sent, or not at all.
     */
    interface Transport {
        /** Returns whether a node of that name is known. */
        boolean reaches(String node);

        /** Sends a message to one node. */
        void send(String node, BusMessage message);

        /** Sends a publication to all other nodes. */
        void broadcast(BusMessage publication);

        /** Called when the node is closed: no message follows. */
        void close();
    }

    /** For a bus without other nodes. */
    private static final Transport NOWHERE = new Transport() {
        @Override
        public boolean reaches(String node) {
            return false;
        }

        @Override
        public void send(String node, BusMessage message) {
            throw new IllegalStateException("there is no way to node " + node);
        }

        @Override
        public void broadcast(BusMessage publication) {}

        @Override
        public void close() {}
    };

    final BusSettings settings;
    final Counters counters = new Counters();
    final ObserverNotifier notifier;
    private final String name;
    private final Transport transport;
    private final Directory directory;
    private final PendingRequests pendingRequests = new PendingRequests(this);
    private final RecordCopier copier = new RecordCopier();
    private final AtomicLong numbers = new AtomicLong();
    private final AtomicBoolean closed = new AtomicBoolean();

    Bus(String name, BusSettings settings, Transport transport) {
        this.name = new Address(name, "bus").node(); // validates the name
        this.settings = settings;
        this.notifier = new ObserverNotifier(settings.observer(), counters);
        this.transport = transport;
        this.directory = new Directory(name);
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
        return new Bus(node, settings, NOWHERE);
    }

    /** The name of this process on the bus. */
    public String node() {
        return name;
    }

    /**
     * Attaches a port under a name.
     *
     * @throws IllegalArgumentException if the name is taken
     */
    public BusPort attach(String portName) {
        var port = new BusPort(this, new Address(name, portName));
        directory.add(port);
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
            directory.ports().forEach(port -> port.close("the bus " + name + " is closed"));
            transport.close();
        }
    }

    /** The message counts since the bus was opened. */
    public BusMetrics metrics() {
        return counters.now();
    }

    // ---- called by ports

    void use(BusTopic<?> topic) {
        directory.use(topic);
    }

    void release(BusTopic<?> topic) {
        directory.release(topic);
    }

    void add(TopicSubscription<?> subscription) {
        directory.add(subscription);
    }

    void remove(TopicSubscription<?> subscription) {
        directory.remove(subscription);
    }

    void detach(BusPort port) {
        directory.remove(port);
    }

    void publish(BusPort from, BusTopic<?> topic, Record payload) {
        counters.published.increment();
        route(new BusMessage.Data(from.address(), new Purpose.Publication(topic.name()), nextNumber(), payload));
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            BusPort requester, Address to, Operation<Q, A> operation, Q request, Duration limit) {
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

    /** The requester has cancelled. Only a request handler on this node is notified of that. */
    void requestCancelled(BusMessage message) {
        if (message.purpose() instanceof Purpose.Request request
                && request.to().node().equals(name)) {
            BusPort port = directory.port(request.to().name());
            OperationHandler<?, ?> operationHandler = port == null ? null : port.operationHandler(request.operation());
            if (operationHandler != null) {
                operationHandler.forget(message);
            }
        }
    }

    /**
     * Returns whether the requester still waits for the reply. True for every requester on another node, because its
     * state is not known here.
     */
    boolean isAwaited(BusMessage request) {
        return isFromAnother(request) || pendingRequests.isAwaited(request);
    }

    /** Returns whether the message was sent by another node. */
    boolean isFromAnother(BusMessage message) {
        return !message.from().node().equals(name);
    }

    // ---- messages

    /** Sends a message that originates from this node. */
    void route(BusMessage message) {
        notifier.passed(message);
        switch (message.purpose()) {
            case Purpose.Publication publication -> {
                deliver(message);
                broadcast(message);
            }
            case Purpose.Request request -> send(request.to(), message);
            case Purpose.Reply reply -> send(reply.to(), message);
            case Purpose.Rejection rejection -> send(rejection.to(), message);
        }
    }

    private void send(Address to, BusMessage message) {
        if (to.node().equals(name)) {
            deliver(message);
        } else if (!transport.reaches(to.node())) {
            cannotSend(message, "there is no way from node " + name + " to node " + to.node());
        } else {
            try {
                transport.send(to.node(), message);
            } catch (RuntimeException | Error failure) {
                cannotSend(message, "the way from node " + name + " to node " + to.node() + " failed: " + failure);
            }
        }
    }

    private void cannotSend(BusMessage message, String why) {
        notifier.undeliverable(message, why);
        pendingRequests.reject(message.sequence(), why); // does nothing if the message is no request
        if (message.purpose() instanceof Purpose.Reply reply) { // a refusal is small and may be sent successfully
            var purpose = new Purpose.Rejection(reply.to(), reply.operation(), reply.request());
            route(BusMessage.of(
                    message.kind(),
                    message.from(),
                    purpose,
                    nextNumber(),
                    new Failure.NotDelivered("the answer could not be sent: " + why)));
        }
    }

    private void broadcast(BusMessage publication) {
        try {
            transport.broadcast(publication);
        } catch (RuntimeException | Error failure) {
            notifier.undeliverable(publication, "the way from node " + name + " to the others failed: " + failure);
        }
    }

    /** Called by the transport: a message from another node has arrived. */
    void receive(BusMessage message) {
        notifier.passed(message);
        deliver(message);
    }

    private void deliver(BusMessage message) {
        switch (message.purpose()) {
            case Purpose.Publication publication -> deliverToAll(message, publication.topic());
            case Purpose.Request request -> deliverRequest(message, request);
            case Purpose.Reply reply -> pendingRequests.settle(message, reply.request());
            case Purpose.Rejection rejection -> pendingRequests.settle(message, rejection.request());
        }
    }

    private void deliverToAll(BusMessage message, String topic) {
        for (TopicSubscription<?> subscription : directory.subscriptions(topic)) {
            if (subscription.topic.type().isInstance(message.payload())) {
                subscription.offer(message); // a subscription that has just ended ignores it
            } else {
                notifier.undeliverable(
                        message,
                        "it is a " + message.payload().getClass().getName() + ", and " + subscription.port
                                + " expects a " + subscription.topic.type().getName());
            }
        }
    }

    private void deliverRequest(BusMessage message, Purpose.Request request) {
        Address to = request.to();
        BusPort port = directory.port(to.name());
        if (port == null) {
            reject(to, message, "nobody is there; " + directory.hint(to.name()));
            return;
        }
        OperationHandler<?, ?> operationHandler = port.operationHandler(request.operation());
        if (operationHandler == null) {
            reject(to, message, "it does not answer that; " + Suggestions.hint(request.operation(), port.operations()));
            return;
        }
        if (!operationHandler.operation.request().isInstance(message.payload())) {
            reject(
                    to,
                    message,
                    "the question is a " + message.payload().getClass().getName() + ", expected a "
                            + operationHandler.operation.request().getName());
            return;
        }
        String ended = operationHandler.offer(message);
        if (ended != null) {
            reject(to, message, "it does not answer any more: " + ended);
        }
    }

    /** Rejects a request that is not delivered to a handler. */
    void reject(Address receiver, BusMessage request, String why) {
        notifier.undeliverable(request, why);
        route(rejection(receiver, request, new Failure.NotDelivered(why)));
    }

    BusMessage rejection(Address receiver, BusMessage request, Record failure) {
        var purpose = new Purpose.Rejection(request.from(), operationOf(request), request.sequence());
        return BusMessage.of(request.kind(), receiver, purpose, nextNumber(), failure);
    }

    BusMessage reply(Address receiver, BusMessage request, Record reply) {
        var purpose = new Purpose.Reply(request.from(), operationOf(request), request.sequence());
        return BusMessage.of(request.kind(), receiver, purpose, nextNumber(), reply);
    }

    private static String operationOf(BusMessage message) {
        if (message.purpose() instanceof Purpose.Request request) {
            return request.operation();
        }
        throw new IllegalStateException("not a question: " + message);
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
