package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.Arrays;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicIntegerArray;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class SensingThreadsTest {
    private static long fingerprint(int threads) {
        try (World world = World.create(
                Tiles.world(50, 1, Specs.RED, Specs.GREEN, Specs.BLUE),
                WorldSettings.DEFAULT.withSensingThreads(threads))) {
            var fingerprint = new Fingerprint();
            fingerprint.add(world.latest());
            for (int tick = 0; tick < 300; tick++) {
                Tiles.wander(world.view());
                fingerprint.add(world.advance());
            }
            return fingerprint.value();
        }
    }

    @Test
    void threads_changeNoBit() {
        long one = fingerprint(1);

        assertThat(fingerprint(2)).isEqualTo(one);
        assertThat(fingerprint(4)).isEqualTo(one);
    }

    @Test
    void everyRobot_isInOneRange_eachOfWhichHasItsOwnThread() {
        for (int robots : new int[] {3, 10, 1000}) {
            var visits = new AtomicIntegerArray(robots);
            var threads = new Thread[3];
            try (var sensing = new SensingThreads("test", 3, robots, (range, from, to) -> {
                threads[range] = Thread.currentThread();
                for (int i = from; i < to; i++) {
                    visits.incrementAndGet(i);
                }
            })) {
                for (int round = 1; round <= 50; round++) {
                    sensing.run();
                    for (int i = 0; i < robots; i++) {
                        assertThat(visits.get(i))
                                .as("robot %d of %d", i, robots)
                                .isEqualTo(round);
                    }
                }
                assertThat(threads[0]).isSameAs(Thread.currentThread());
                assertThat(Arrays.asList(threads).subList(1, 3)).isEqualTo(sensing.helpers());
            }
        }
    }

    @Test
    void failureOnAThread_isThrownToTheCaller_andTheNextRunIsWhole() {
        var fails = new boolean[] {true};
        try (var sensing = new SensingThreads("test", 2, 2, (range, from, to) -> {
            if (range == 1 && fails[0]) {
                throw new IllegalArgumentException("broken sonar");
            }
        })) {
            assertThatThrownBy(sensing::run).hasMessage("broken sonar");
            fails[0] = false;
            sensing.run();
        }
    }

    @Test
    void close_endsTheThreads_andOneIsEnoughAfterwards() throws InterruptedException {
        var visits = new AtomicIntegerArray(5);
        var sensing = new SensingThreads("test", 4, 5, (range, from, to) -> {
            for (int i = from; i < to; i++) {
                visits.incrementAndGet(i);
            }
        });
        sensing.run();
        sensing.close();
        for (Thread helper : sensing.helpers()) {
            assertThat(helper.join(java.time.Duration.ofSeconds(30))).isTrue();
        }

        sensing.run();

        assertThat(visits).hasToString("[2, 2, 2, 2, 2]");
    }

    @Test
    void closedWorld_refusesToAdvance_andKeepsItsLastSnapshot() throws Exception {
        World world = World.create(Tiles.world(4, 1), WorldSettings.DEFAULT.withSensingThreads(2));
        Snapshot last = world.advance();
        CompletableFuture.runAsync(world::close).get(30, TimeUnit.SECONDS);

        assertThatThrownBy(world::advance)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("world 'test' is closed");
        assertThat(world.latest()).isSameAs(last);
    }

    @Test
    void interruptedCaller_stillGetsAllReadings_andStaysInterrupted() {
        World world = World.create(Tiles.world(50, 1), WorldSettings.DEFAULT.withSensingThreads(2));
        World other = World.create(world.spec(), WorldSettings.DEFAULT);
        Thread.currentThread().interrupt();

        Snapshot snapshot = world.advance();

        assertThat(Thread.interrupted()).isTrue();
        assertThat(snapshot).isEqualTo(other.advance());
        world.close();
    }
}
