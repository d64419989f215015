package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Address;
import io.troupe.bus.BusException;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Loss;
import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Executors;
import java.util.concurrent.FutureTask;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** Faults of the connection and of what is at its ends. */
class NatsFaultsTest extends NatsTest {
    // ---- too much, and too large

    /** Holds up the thread that delivers publications, as an observer must not do. */
    private static final class Blocking implements BusObserver {
        final CountDownLatch release = new CountDownLatch(1);
        final BlockingQueue<Object> events;

        Blocking(BlockingQueue<Object> events) {
            this.events = events;
        }

        @Override
        public void lost(Loss loss) {
            events.add(loss);
        }

        @Override
        public void passed(BusMessage message) {
            if (message.purpose() instanceof BusMessage.Purpose.Publication) {
                try {
                    release.await();
                } catch (InterruptedException interrupted) {
                    throw new AssertionError(interrupted);
                }
            }
        }
    }

    @Test
    void clientThatReceivesMoreThanItCanHandle_dropsTheNewest_andEachIsCounted() throws Exception {
        try (var server = NatsServer.start()) {
            var at = server.settings();
            var seen = new LinkedBlockingQueue<Object>();
            var observer = new Blocking(seen);
            var far = open("far", new NatsEngine(at, 100), BusSettings.on(space).withObserver(observer))
                    .attach("port");
            far.answer(SPELL, NatsTest::spell);
            far.subscribe(COUNTS, (count, from) -> seen.add(count.value()));
            var near = open("near", at).attach("a");
            assertThat(answer(near, far.address())).as("it has subscribed").isEqualTo("number 7");
            IntStream.range(0, 1000).forEach(each -> near.publish(COUNTS, new Count(each)));
            assertThat(answer(near, far.address()))
                    .as("requests get through, and all values have arrived or were dropped")
                    .isEqualTo("number 7");
            observer.release.countDown();

            var received = new ArrayList<Integer>();
            long lost = 0;
            String text = "";
            while (received.size() + lost < 1000) {
                Object next = seen.poll(60, TimeUnit.SECONDS);
                switch (next) {
                    case Integer value -> received.add(value);
                    case Loss.LostOnTheWay drops -> {
                        lost += drops.messages();
                        text = drops.toString();
                    }
                    case Loss.Missed gap -> assertThat(gap.count()).isPositive(); // the same ones, by their numbers
                    case null, default -> throw new AssertionError("unexpected: " + next);
                }
            }
            assertThat(lost).isPositive();
            assertThat(received.size() + lost).isEqualTo(1000);
            assertThat(received)
                    .as("those that waited; one more if the first was taken late")
                    .hasSizeBetween(100, 101)
                    .startsWith(IntStream.range(0, 100).boxed().toArray(Integer[]::new));
            assertThat(text).endsWith("lost: node far receives more than it can handle: 100 frames wait");
        }
    }

    @Test
    void valueAtTheLimitOfTheServer_isDelivered_andALargerOneIsReported() throws Exception {
        try (var server = NatsServer.configured(folder, "max_payload: 4096")) {
            var at = server.settings();
            var received = new LinkedBlockingQueue<Integer>();
            var far = speller("far", at);
            far.subscribe(TEXTS, (text, from) -> received.add(text.value().length()));
            var near = open("near", at).attach("a");
            assertThat(answer(near, far.address())).isEqualTo("number 7");
            for (int length = 3_950; length <= 4_096; length++) {
                near.publish(TEXTS, new Text("x".repeat(length)));
            }
            assertThat(answer(near, far.address())).isEqualTo("number 7");
            String first = next(losses);
            assertThat(first).endsWith("bytes, expected at most 4096");
            int refused = losses.size() + 1;
            for (int length = 3_950; length <= 4_096 - refused; length++) {
                assertThat(received.poll(60, TimeUnit.SECONDS)).isEqualTo(length);
            }
            assertThat(refused).as("the header has less than 100 bytes").isBetween(1, 100);
            assertThat(events).as("the server has not disconnected anyone").isEmpty();
        }
    }

    @Test
    void floodOfValues_doesNotHoldUpRequests() throws Exception {
        try (var server = NatsServer.start()) {
            var at = server.settings();
            var quiet = BusSettings.on(space).withObserver(loss -> {});
            var far = open("far", new NatsEngine(at), quiet).attach("port");
            far.answer(SPELL, NatsTest::spell);
            var received = new CountDownLatch(10_000);
            far.subscribe(COUNTS, (count, from) -> received.countDown());
            var flooder = open("flooder", new NatsEngine(at), quiet).attach("a");
            var near = open("near", at).attach("a");
            assertThat(answer(near, far.address())).isEqualTo("number 7");
            var goesOn = new AtomicBoolean(true);
            // A server cuts off a reader that is 64 MB behind, and a busy machine may hold one up for seconds. An
            // answer shows that all values before the request have been read.
            var flood = new FutureTask<>(() -> {
                for (int i = 1; goesOn.get(); i++) {
                    flooder.publish(COUNTS, new Count(i));
                    if (i % 50_000 == 0) {
                        answer(flooder, far.address());
                    }
                }
                return "over";
            });
            Thread.ofPlatform().start(flood);
            try {
                for (int i = 0; i < 200; i++) {
                    assertThat(answer(near, far.address())).isEqualTo("number 7");
                }
                assertThat(received.await(60, TimeUnit.SECONDS)).as("a flood").isTrue();
            } finally {
                goesOn.set(false);
                assertThat(flood.get(60, TimeUnit.SECONDS)).isEqualTo("over");
            }
        }
    }

    // ---- what the server does not permit

    private static final String PERMISSIONS = """
            authorization {
              users = [
                {user: all, password: p, permissions: {publish: "troupe.>", subscribe: "troupe.>"}}
                {user: noTopics, password: p, permissions: {publish: "troupe.>",
                  subscribe: ["troupe.who.>", "troupe.n.>", "troupe.x.>", "troupe.g.>"]}}
                {user: noNode, password: p, permissions: {publish: "troupe.>", subscribe: "troupe.x.>"}}
                {user: noRequests, password: p, permissions: {publish: ["troupe.who.>", "troupe.x.>"],
                  subscribe: "troupe.>"}}
              ]
            }
            """;

    @Test
    void permissionThatIsMissing_forATopic_orForReceivingAtAll_isReportedInOneLine() throws Exception {
        try (var server = NatsServer.configured(folder, PERMISSIONS)) {
            var at = server.settings();
            open("one", at.withUser("noTopics", "p")).attach("a").subscribe(COUNTS, (count, from) -> {});
            assertThat(next(losses))
                    .startsWith("messages may have been lost: the server does not permit it to node one: ")
                    .contains("Subscription to \"troupe.t.robot%201.counts%2eall\"")
                    .endsWith("; the user needs publish and subscribe permission for \"troupe.>\"");
            assertThatThrownBy(() -> open("two", at.withUser("noNode", "p")))
                    .isInstanceOf(BusException.class)
                    .hasMessageStartingWith("node two cannot be opened on " + server.address()
                            + ": the server does not permit it to node two: ")
                    .hasMessageEndingWith("; the user needs publish and subscribe permission for \"troupe.>\"");
        }
    }

    @Test
    void requestThatIsNotPermitted_isRejectedAtOnce() throws Exception {
        try (var server = NatsServer.configured(folder, PERMISSIONS)) {
            var at = server.settings();
            speller("far 2", at.withUser("all", "p"));
            var asker = open("near", at.withUser("noRequests", "p")).attach("a");
            var to = new Address("far 2", "port");
            assertThatThrownBy(() -> asker.ask(to, SPELL, new Count(1), Duration.ofDays(1))
                            .get(LONG))
                    .isInstanceOf(BusException.class)
                    .hasMessageStartingWith(
                            "near/a asked far 2/port for spell: the server does not permit it to node near: ")
                    .hasMessageContaining("Publish to \"troupe.n.far%202\"");
            assertThat(next(losses)).startsWith("request to far 2/port for spell from near/a");
            asker.send(to, SPELL, new Count(2));
            assertThat(next(losses)).startsWith("notice to far 2/port for spell from near/a");
        }
    }

    @Test
    void userWithAnEmptyPassword_isRefused() throws Exception {
        try (var server = NatsServer.start(List.of("--user", "ada", "--pass", "secret"))) {
            var empty = server.settings().withUser("ada", "");
            assertThatThrownBy(() -> open("x", empty))
                    .hasMessage("node x cannot connect to " + server.address()
                            + ": the server does not accept the user \"ada\" with that password");
        }
    }

    // ---- servers that end

    /** Two servers of a cluster that know each other. */
    private record Cluster(NatsServer one, NatsServer other) implements AutoCloseable {
        @Override
        public void close() {
            one.close();
            other.close();
        }
    }

    private Cluster cluster(Path configuration) throws Exception {
        NatsServer.assumeInstalled();
        int oneRoute = NatsServer.freePort();
        int otherRoute = NatsServer.freePort();
        var cluster =
                new Cluster(member(configuration, oneRoute, otherRoute), member(configuration, otherRoute, oneRoute));
        var probe = open("probe", cluster.one.settings()).attach("a");
        var other = speller("other", cluster.other.settings());
        assertThat(answerAtLast(probe, other.address())).isEqualTo("number 7");
        losses.clear();
        return cluster;
    }

    private static NatsServer member(Path configuration, int route, int otherRoute) throws IOException {
        return NatsServer.start(List.of(
                "-c",
                configuration.toString(),
                "--cluster_name",
                "test",
                "--cluster",
                "nats://127.0.0.1:" + route,
                "--routes",
                "nats://127.0.0.1:" + otherRoute));
    }

    private Path write(String configuration) throws IOException {
        return Files.writeString(folder.resolve("member.conf"), configuration);
    }

    /** Nodes that know only one server, at which the node {@code probe} is too. */
    private List<BusPort> nodesAt(NatsServer server) throws Exception {
        var at = server.settings();
        var nodes = List.of(speller("near", at), speller("far", at));
        assertThat(answer(nodes.getFirst(), nodes.getLast().address())).isEqualTo("number 7");
        return nodes;
    }

    /** Waits until the nodes that were at the server are connected again. */
    private void awaitConnected(int nodes) throws InterruptedException {
        var all = new ArrayList<String>();
        while (all.stream().filter("connected"::equals).count() < nodes) {
            all.add(next(events));
            assertThat(all).doesNotContain("null");
        }
        assertThat(all).containsOnly("disconnected", "connected").hasSize(2 * nodes);
    }

    @Test
    void serverThatIsKilled_isReplacedByAnotherOfItsCluster() throws Exception {
        try (var cluster = cluster(write(""))) {
            var nodes = nodesAt(cluster.one);
            cluster.one.kill();
            awaitConnected(3);
            assertThat(answerAtLast(nodes.getFirst(), nodes.getLast().address()))
                    .isEqualTo("number 7");
        }
    }

    @Test
    void serverThatSendsItsClientsAway_isReplacedByAnotherOfItsCluster() throws Exception {
        try (var cluster = cluster(write("lame_duck_grace_period: \"1ms\"\nlame_duck_duration: \"30s\"\n"))) {
            var nodes = nodesAt(cluster.one);
            cluster.one.signal("USR2");
            awaitConnected(3);
            cluster.one.kill();
            assertThat(answerAtLast(nodes.getFirst(), nodes.getLast().address()))
                    .isEqualTo("number 7");
        }
    }

    // ---- a process that is frozen

    /** A node in a process: prints the numbers that it receives. */
    static final class Child {
        static final BusTopic<Count> FRESH = new BusTopic<>("fresh", Count.class).withMaxAge(Duration.ofMillis(300));

        private Child() {}

        public static void main(String[] arguments) throws InterruptedException {
            try (var space = ActorSpace.create(SpaceSettings.named("child"));
                    var bus = NatsBus.open(
                            "child",
                            NatsSettings.at(arguments[0]).withConnectLimit(LONG),
                            BusSettings.on(space).withObserver(loss -> {}))) {
                bus.attach("a").subscribe(FRESH, (count, from) -> System.out.println(count.value()));
                new CountDownLatch(1).await(); // until it is killed
            }
        }
    }

    @Test
    void processThatWasFrozen_doesNotReceiveWhatIsTooOld() throws Exception {
        try (var server = NatsServer.start()) {
            var child = new ProcessBuilder(
                            ProcessHandle.current().info().command().orElseThrow(),
                            "-cp",
                            System.getProperty("java.class.path"),
                            Child.class.getName(),
                            server.address())
                    .redirectError(ProcessBuilder.Redirect.DISCARD)
                    .start();
            try (var publishing = Executors.newSingleThreadScheduledExecutor()) {
                var values = new Values(open("near", server.settings()).attach("a"));
                publishing.scheduleAtFixedRate(values::publishNext, 0, 10, TimeUnit.MILLISECONDS);
                assertThatNothingOldArrives(child, values);
                publishing.shutdownNow();
            } finally {
                child.destroyForcibly().waitFor();
            }
        }
    }

    /** Publishes numbers, and keeps when. */
    private static final class Values {
        final Map<Integer, Long> sentNanos = new ConcurrentHashMap<>();
        final Semaphore sent = new Semaphore(0);
        private final BusPort port;
        private volatile int last;

        Values(BusPort port) {
            this.port = port;
        }

        void publishNext() {
            int number = last + 1;
            sentNanos.put(number, System.nanoTime());
            port.publish(Child.FRESH, new Count(number));
            last = number;
            sent.release();
        }
    }

    private static void assertThatNothingOldArrives(Process child, Values values) throws Exception {
        var lines = child.inputReader();
        var received = new ArrayList<Integer>();
        while (received.size() < 50) { // after them it is known how long a value is usually on its way
            received.add(Integer.valueOf(lines.readLine()));
        }
        NatsServerProcess.signal(child, "STOP");
        int frozenAt = values.last;
        values.sent.drainPermits();
        assertThat(values.sent.tryAcquire(500, 120, TimeUnit.SECONDS))
                .as("five seconds")
                .isTrue();
        long goesOnNanos = System.nanoTime();
        NatsServerProcess.signal(child, "CONT");
        int goesOnAt = values.last;
        while (received.getLast() < goesOnAt + 50) {
            received.add(Integer.valueOf(lines.readLine()));
        }
        long oldestNanos = goesOnNanos
                - Duration.ofMillis(300).toNanos()
                - Duration.ofSeconds(1).toNanos();
        assertThat(received)
                .filteredOn(number -> number > frozenAt + 100)
                .as("values after the pause were not published long before its end")
                .allMatch(number -> values.sentNanos.get(number) > oldestNanos);
    }
}
