package io.troupe.bus.nats;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusException;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Loss;
import io.troupe.bus.Operation;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Base class of tests with nodes at real servers. */
@Tag("threads")
@Timeout(value = 180, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
abstract class NatsTest {
    record Count(int value) {}

    record Text(String value) {}

    static final BusTopic<Count> COUNTS = new BusTopic<>("robot 1/counts.all", Count.class);
    static final BusTopic<Text> TEXTS = new BusTopic<>("texts", Text.class);
    static final Operation<Count, Text> SPELL = new Operation<>("spell", Count.class, Text.class, Operation.Kind.DATA);
    static final Duration LONG = Duration.ofSeconds(60);

    final ActorSpace space = ActorSpace.create(SpaceSettings.named("nats test"));
    final BlockingQueue<String> losses = new LinkedBlockingQueue<>();
    final BlockingQueue<String> events = new LinkedBlockingQueue<>();
    private final List<Bus> open = new ArrayList<>(); // guarded by itself

    @TempDir
    Path folder;

    final BusSettings settings = BusSettings.on(space).withObserver(new BusObserver() {
        @Override
        public void lost(Loss loss) {
            losses.add(loss.toString());
        }

        @Override
        public void disconnected(String why) {
            events.add("disconnected");
        }

        @Override
        public void connected() {
            events.add("connected");
        }
    });

    @AfterEach
    void closeAll() {
        synchronized (open) {
            open.forEach(Bus::close);
        }
        space.close();
    }

    /** A node that is closed at the end of the test. */
    final Bus open(String node, NatsSettings server) {
        return open(node, new NatsEngine(server), settings);
    }

    final Bus open(String node, BusEngine engine, BusSettings itsSettings) {
        Bus bus = Bus.open(node, engine, itsSettings);
        synchronized (open) {
            open.add(bus);
        }
        return bus;
    }

    /** A port called "port" that spells numbers, of a new node. */
    final BusPort speller(String node, NatsSettings server) {
        var port = open(node, server).attach("port");
        port.answer(SPELL, NatsTest::spell);
        return port;
    }

    static Promise<Text> spell(Count count) {
        return Promise.of(new Text("number " + count.value()));
    }

    static String answer(BusPort asker, Address to) throws Exception {
        return asker.ask(to, SPELL, new Count(7), LONG).get(LONG).value();
    }

    /** Asks until servers that have just been connected know of each other's nodes. */
    static String answerAtLast(BusPort asker, Address to) throws Exception {
        while (true) {
            try {
                return answer(asker, to);
            } catch (BusException notYet) {
                if (!String.valueOf(notYet.getMessage()).endsWith("no node of that name is connected now")) {
                    throw notYet;
                }
            }
        }
    }

    static String next(BlockingQueue<String> queue) throws InterruptedException {
        return String.valueOf(queue.poll(60, TimeUnit.SECONDS));
    }
}
