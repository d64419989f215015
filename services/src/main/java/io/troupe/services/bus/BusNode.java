package io.troupe.services.bus;

import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Message.Failure;
import io.troupe.services.bus.Message.Purpose;
import io.troupe.services.text.Suggestions;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;

/**
 * The bus as one process sees it: routes messages between its ports and, over the {@link Transport}, to other nodes. A
 * kind of bus differs from others only in its transport.
 */
final class BusNode implements Bus {
    final BusSettings settings;
    final Counters counters = new Counters();
    final Telling telling;
    private final String name;
    private final Transport transport;
    private final Directory directory;
    private final Questions questions = new Questions(this);
    private final Detacher detacher = new Detacher();
    private final AtomicLong numbers = new AtomicLong();
    private final AtomicBoolean closed = new AtomicBoolean();

    BusNode(String name, BusSettings settings, Transport transport) {
        this.name = new Address(name, "bus").node(); // validates the name
        this.settings = settings;
        this.telling = new Telling(settings.observer(), counters);
        this.transport = transport;
        this.directory = new Directory(name);
    }

    @Override
    public String node() {
        return name;
    }

    @Override
    public BusPort attach(String portName) {
        var port = new Port(this, new Address(name, portName));
        directory.add(port);
        if (closed.get()) {
            port.close("the bus " + name + " is closed");
            throw new BusException(port + " cannot be attached: the bus " + name + " is closed");
        }
        return port;
    }

    @Override
    public void close() {
        if (closed.compareAndSet(false, true)) {
            directory.ports().forEach(port -> port.close("the bus " + name + " is closed"));
            transport.close();
        }
    }

    BusMetrics metrics() {
        return counters.now();
    }

    // ---- called by ports

    void use(Topic<?> topic) {
        directory.use(topic);
    }

    void release(Topic<?> topic) {
        directory.release(topic);
    }

    void add(Hearing<?> hearing) {
        directory.add(hearing);
    }

    void remove(Hearing<?> hearing) {
        directory.remove(hearing);
    }

    void detach(Port port) {
        directory.remove(port);
    }

    void publish(Port from, Topic<?> topic, Record payload) {
        counters.published.increment();
        route(new DataMessage(from.address(), new Purpose.Publication(topic.name()), nextNumber(), payload));
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            Port asker, Address to, Operation<Q, A> operation, Q question, Duration limit) {
        return questions.ask(asker, to, operation, question, limit);
    }

    void rejectQuestionsOf(Port asker, String why) {
        questions.refuseAllOf(asker, why);
    }

    long nextNumber() {
        return numbers.incrementAndGet();
    }

    /** A copy of the value that shares no mutable object with it, as if it had been sent to another process. */
    Record detached(Record value) {
        return detacher.detached(value);
    }

    /** The requester has cancelled. Only a request handler on this node is notified of that. */
    void forgetQuestion(Message message) {
        if (message.purpose() instanceof Purpose.Question question
                && question.to().node().equals(name)) {
            Port port = directory.port(question.to().name());
            Answering<?, ?> answering = port == null ? null : port.answering(question.operation());
            if (answering != null) {
                answering.forget(message);
            }
        }
    }

    /**
     * Returns whether the requester still waits for the reply. True for every requester on another node, because its
     * state is not known here.
     */
    boolean isAwaited(Message question) {
        return isFromAnother(question) || questions.isAwaited(question);
    }

    /** Returns whether the message was sent by another node. */
    boolean isFromAnother(Message message) {
        return !message.from().node().equals(name);
    }

    // ---- messages

    /** Sends a message that originates from this node. */
    void route(Message message) {
        telling.passed(message);
        switch (message.purpose()) {
            case Purpose.Publication publication -> {
                deliver(message);
                broadcast(message);
            }
            case Purpose.Question question -> send(question.to(), message);
            case Purpose.Answer answer -> send(answer.to(), message);
            case Purpose.Refusal refusal -> send(refusal.to(), message);
        }
    }

    private void send(Address to, Message message) {
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

    private void cannotSend(Message message, String why) {
        telling.undeliverable(message, why);
        questions.refuse(message.sequence(), why); // does nothing if the message is no request
        if (message.purpose() instanceof Purpose.Answer answer) { // a refusal is small and may be sent successfully
            var purpose = new Purpose.Refusal(answer.to(), answer.operation(), answer.question());
            route(Message.of(
                    message.kind(),
                    message.from(),
                    purpose,
                    nextNumber(),
                    new Failure.NotDelivered("the answer could not be sent: " + why)));
        }
    }

    private void broadcast(Message publication) {
        try {
            transport.broadcast(publication);
        } catch (RuntimeException | Error failure) {
            telling.undeliverable(publication, "the way from node " + name + " to the others failed: " + failure);
        }
    }

    /** Called by the transport: a message from another node has arrived. */
    void receive(Message message) {
        telling.passed(message);
        deliver(message);
    }

    private void deliver(Message message) {
        switch (message.purpose()) {
            case Purpose.Publication publication -> deliverToAll(message, publication.topic());
            case Purpose.Question question -> deliverQuestion(message, question);
            case Purpose.Answer answer -> questions.settle(message, answer.question());
            case Purpose.Refusal refusal -> questions.settle(message, refusal.question());
        }
    }

    private void deliverToAll(Message message, String topic) {
        for (Hearing<?> hearing : directory.hearings(topic)) {
            if (hearing.topic.type().isInstance(message.payload())) {
                hearing.offer(message); // a subscription that has just ended ignores it
            } else {
                telling.undeliverable(
                        message,
                        "it is a " + message.payload().getClass().getName() + ", and " + hearing.port + " expects a "
                                + hearing.topic.type().getName());
            }
        }
    }

    private void deliverQuestion(Message message, Purpose.Question question) {
        Address to = question.to();
        Port port = directory.port(to.name());
        if (port == null) {
            refuse(to, message, "nobody is there; " + directory.hint(to.name()));
            return;
        }
        Answering<?, ?> answering = port.answering(question.operation());
        if (answering == null) {
            refuse(
                    to,
                    message,
                    "it does not answer that; " + Suggestions.hint(question.operation(), port.operations()));
            return;
        }
        if (!answering.operation.question().isInstance(message.payload())) {
            refuse(
                    to,
                    message,
                    "the question is a " + message.payload().getClass().getName() + ", expected a "
                            + answering.operation.question().getName());
            return;
        }
        String ended = answering.offer(message);
        if (ended != null) {
            refuse(to, message, "it does not answer any more: " + ended);
        }
    }

    /** Rejects a request that is not delivered to a handler. */
    void refuse(Address answerer, Message question, String why) {
        telling.undeliverable(question, why);
        route(refusal(answerer, question, new Failure.NotDelivered(why)));
    }

    Message refusal(Address answerer, Message question, Record failure) {
        var purpose = new Purpose.Refusal(question.from(), operationOf(question), question.sequence());
        return Message.of(question.kind(), answerer, purpose, nextNumber(), failure);
    }

    Message answer(Address answerer, Message question, Record answer) {
        var purpose = new Purpose.Answer(question.from(), operationOf(question), question.sequence());
        return Message.of(question.kind(), answerer, purpose, nextNumber(), answer);
    }

    private static String operationOf(Message message) {
        if (message.purpose() instanceof Purpose.Question question) {
            return question.operation();
        }
        throw new IllegalStateException("not a question: " + message);
    }

    @Override
    public String toString() {
        return "bus " + name;
    }
}
