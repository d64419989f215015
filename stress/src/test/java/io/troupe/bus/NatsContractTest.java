package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.bus.nats.ContractServer;
import java.io.IOException;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Objects;
import java.util.Queue;
import java.util.UUID;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;

/**
 * Runs the contract of the bus over a real server.
 *
 * <p>In the package of the contract, of which nothing is public.
 */
@Tag("threads")
class NatsContractTest extends BusContractTest {
    private static final AtomicReference<@Nullable ContractServer> SERVER = new AtomicReference<>();

    NatsContractTest(Wiring wiring) {
        super(wiring);
    }

    @BeforeAll
    static void start() throws IOException {
        SERVER.set(ContractServer.start());
    }

    @AfterAll
    static void stop() {
        ContractServer server = SERVER.getAndSet(null);
        if (server != null) {
            server.close();
        }
    }

    @Override
    Pipe pipe(ActorSpace carrier) {
        return new NatsPipe(Objects.requireNonNull(SERVER.get()), carrier);
    }

    @Override
    String noWayTo(String node) {
        return near == far ? super.noWayTo(node) : "no node of that name is connected now";
    }

    /**
     * Keeps what has arrived from the server until the test carries it. To carry is to wait until what was sent has
     * arrived: until marks that were sent after it, in both directions, have arrived by each of the ways of a frame.
     */
    private static final class NatsPipe implements Pipe {
        private static final byte[] MARK = {0};
        private static final String MARKS = "marks of the test";

        private final ContractServer server;
        private final ActorSpace carrier;
        private final String application = UUID.randomUUID().toString(); // a test never sees the nodes of another one
        private final List<End> open = new ArrayList<>();
        private boolean isUnderWay;

        NatsPipe(ContractServer server, ActorSpace carrier) {
            this.server = server;
            this.carrier = carrier;
        }

        @Override
        public Bus open(String node, BusSettings settings) {
            return Bus.open(node, new End(), settings);
        }

        @Override
        public void carryAll() {
            while (isUnderWay) {
                isUnderWay = false;
                awaitArrival();
                List.copyOf(open).forEach(End::deliver);
            }
        }

        private void willSend() {
            if (open.size() == 2) {
                isUnderWay = true;
                carrier.execute(this::carryAll);
            }
        }

        private void awaitArrival() {
            if (open.size() == 2) {
                End one = open.getFirst();
                End other = open.getLast();
                one.mark(other);
                other.mark(one);
                one.mark(other); // the server's answers to what the other has sent come before this
            }
        }

        /** The engine of one node. */
        private final class End implements BusEngine, BusEngine.Listener {
            private final BusEngine engine = server.engine(application);
            private final Queue<Consumer<Listener>> arrived = new ConcurrentLinkedQueue<>();
            private final Semaphore marks = new Semaphore(0);
            private String node = "";
            private @Nullable Listener listener;

            @Override
            public void start(String itsNode, long incarnation, Listener itsListener) {
                node = itsNode;
                listener = itsListener;
                engine.start(node, incarnation, this);
                engine.subscribe(MARKS);
                open.add(this);
                if (open.size() == 2) {
                    open.getFirst().markByTheNodesSubject(this); // then the server has the subscriptions of both
                    markByTheNodesSubject(open.getFirst());
                }
            }

            private void markByTheNodesSubject(End to) {
                engine.send(to.node, 0, MARK);
                to.awaitMarks(1);
            }

            void mark(End to) {
                engine.send(to.node, 0, MARK);
                engine.publish(MARKS, MARK);
                to.awaitMarks(2);
            }

            private void awaitMarks(int count) {
                try {
                    if (!marks.tryAcquire(count, 60, TimeUnit.SECONDS)) {
                        throw new AssertionError(count + " marks have not arrived at " + node);
                    }
                } catch (InterruptedException interrupted) {
                    throw new AssertionError(interrupted);
                }
            }

            void deliver() {
                for (var next = arrived.poll(); next != null; next = arrived.poll()) {
                    next.accept(Objects.requireNonNull(listener));
                }
            }

            // ---- what the node sends

            @Override
            public @Nullable String whyDisconnected() {
                return engine.whyDisconnected();
            }

            @Override
            public int maxFrameBytes() {
                return engine.maxFrameBytes();
            }

            @Override
            public void send(String to, long number, byte[] frame) {
                willSend();
                engine.send(to, number, frame);
            }

            @Override
            public void reply(String to, long incarnation, long number, byte[] frame) {
                willSend();
                engine.reply(to, incarnation, number, frame);
            }

            @Override
            public void publish(String topic, byte[] frame) {
                willSend();
                engine.publish(topic, frame);
            }

            @Override
            public void subscribe(String topic) {
                engine.subscribe(topic);
                awaitArrival();
            }

            @Override
            public void unsubscribe(String topic) {
                engine.unsubscribe(topic);
                awaitArrival();
            }

            @Override
            public void close() {
                open.remove(this);
                engine.close();
            }

            // ---- what arrives, on the threads of the client

            @Override
            public void frame(byte[] frame) {
                if (Arrays.equals(frame, MARK)) {
                    marks.release();
                } else {
                    arrived.add(to -> to.frame(frame));
                }
            }

            @Override
            public void unreachable(String to, long number, String why) {
                arrived.add(listening -> listening.unreachable(to, number, why));
            }

            @Override
            public void rejected(String to, String why) {
                arrived.add(listening -> listening.rejected(to, why));
            }

            @Override
            public void gone(String to, long incarnation) {
                arrived.add(listening -> listening.gone(to, incarnation));
            }

            @Override
            public void lost(long frames, String why) {
                arrived.add(listening -> listening.lost(frames, why));
            }

            @Override
            public void disconnected(String why) {
                arrived.add(listening -> listening.disconnected(why));
            }

            @Override
            public void connected() {
                arrived.add(Listener::connected);
            }
        }
    }
}
