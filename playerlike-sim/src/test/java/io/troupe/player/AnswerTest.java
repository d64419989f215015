package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.ScriptedServer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** When a client answers a tick, and when a frame becomes visible to its program. */
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // a busy loop cannot be interrupted
class AnswerTest implements PlayerConstants {
    private final ScriptedServer server = new ScriptedServer();
    private final PlayerPorts.Registration port = PlayerPorts.open(ScriptedServer.PORT, server);
    private final PlayerClient client = new PlayerClient("localhost", ScriptedServer.PORT);
    private final Position2DInterface pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
    private final SonarInterface son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);

    @AfterEach
    void close() {
        client.close();
        port.close();
    }

    /** The reader thread shows the first frame; a poll would already count as an answer. */
    private void runUntilTheFirstFrame() {
        client.runThreaded(-1, -1);
        assertThat(server.answered()).as("waits for its first data").isEqualTo(-1);
        server.publish(0);
        while (pos.getData() == null || son.getData() == null) {
            Thread.onSpinWait();
        }
    }

    // ---- without a thread

    @Test
    void readAll_answers_onlyWhenItWaits() {
        server.publish(0);
        client.readAll();
        assertThat(List.of(pos.isDataReady(), son.isDataReady())).containsExactly(true, false);
        client.readAll();
        assertThat(List.of(pos.isDataReady(), pos.isDataReady()))
                .as("nothing new, but the sonar is still unseen")
                .containsExactly(false, false);
        assertThat(server.answered()).isLessThan(0);
        assertThat(son.isDataReady()).isTrue();
        server.publishAfter(0, 1); // data arrive only in a waiting readAll
        client.readAll();
        assertThat(server.answered()).isZero();
        assertThat(pos.getX()).isEqualTo(1);
    }

    @Test
    void readAll_hasNothingLeft_saysThatTheServerHasGone() {
        server.publish(0);
        server.vanish();
        assertThat(List.of(client.readAll(), client.readAll())).containsOnly((int) PLAYER_MSGTYPE_DATA);
        assertThatThrownBy(client::readAll)
                .isInstanceOf(PlayerException.class)
                .hasMessage("the scripted server has gone");
    }

    // ---- threaded

    @Test
    void frame_becomesVisibleAsAWhole_forWhoWaitsForOneDeviceAndReadsAnother() {
        client.runThreaded(-1, -1);
        for (long tick = 0; tick < 2_000; tick++) {
            server.publishAfter(tick - 1, tick);
            while (!pos.isDataReady())
                ;
            assertThat(son.getData().getRanges()[0]).isEqualTo((float) tick);
        }
    }

    @Test
    void question_isNoAnswer_whileTheOtherDeviceIsUnseen_unlessItIsRepeated() {
        runUntilTheFirstFrame();
        assertThat(List.of(pos.isDataReady(), pos.isDataReady())).containsExactly(true, false);
        assertThat(server.answered()).as("the sonar is unseen").isLessThan(0);
        assertThat(pos.isDataReady()).isFalse();
        assertThat(server.answered()).as("asked in vain again").isZero();
    }

    @Test
    void frame_becomesVisible_firstWithoutAsking_thenWhereTheProgramWaits_whenItHasSeenEverything() {
        runUntilTheFirstFrame();
        assertThat(son.getData().getRanges()).containsExactly(0f);
        assertThat(List.of(pos.isDataReady(), son.isDataReady())).containsExactly(true, true);
        assertThat(server.answered()).isLessThan(0);
        assertThat(pos.isDataReady()).isFalse();
        assertThat(server.answered()).as("the question is the answer").isZero();
        server.publish(1);
        assertThat(son.isDataReady()).as("in the middle of its loop").isFalse();
        assertThat(pos.getX()).isZero();
        assertThat(pos.isDataReady()).as("where it waits").isTrue();
        assertThat(son.isDataReady()).isTrue();
    }

    @Test
    void frame_becomesVisible_whereTheProgramWaitsNow_ifItDoesNotComeBack() {
        var blf = client.requestInterfaceBlobfinder(0, PLAYER_OPEN_MODE);
        runUntilTheFirstFrame();
        assertThat(List.of(pos.isDataReady(), son.isDataReady(), blf.isDataReady(), pos.isDataReady()))
                .containsExactly(true, true, true, false);
        server.publish(1);
        assertThat(List.of(son.isDataReady(), blf.isDataReady())).containsExactly(false, false);
        assertThat(son.isDataReady()).as("a second time, and not the position").isTrue();
    }

    @Test
    void frames_ofAServerThatDoesNotWait_becomeVisible_toAProgramThatDoesNotAsk() {
        client.runThreaded(-1, -1);
        assertThat(pos.isDataReady()).isFalse();
        server.publish(0);
        server.publish(1);
        while (pos.getTimestamp() < 0.1 || son.getTimestamp() < 0.1) {
            Thread.onSpinWait();
        }
        assertThat(pos.getX()).isEqualTo(1);
        assertThat(son.getData().getRanges()).containsExactly(1f);
    }

    @Test
    void promise_off_spaces_answersAndComesWithTheFrame() throws Exception {
        runUntilTheFirstFrame();
        var next = client.nextData();
        assertThat(server.answered()).isZero();
        server.publish(1);
        next.get(Duration.ofSeconds(30));
        assertThat(pos.getX()).isEqualTo(1);
    }

    @Test
    void question_ofAnInterruptedThread_isFalse_andItStaysInterrupted() {
        client.runThreaded(-1, -1);
        Thread.currentThread().interrupt();
        assertThat(pos.isDataReady()).isFalse();
        assertThat(Thread.interrupted()).isTrue();
    }

    @Test
    void closedClient_throwsFromEveryCall() {
        client.runThreaded(-1, -1);
        client.close();
        assertThat(client.isAlive()).isFalse();
        assertThat(server.closed).isTrue();
        for (Runnable call : List.<Runnable>of(pos::isDataReady, client::readAll)) {
            assertThatThrownBy(call::run)
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("this client is closed");
        }
        assertThat(client.nextData().error()).isInstanceOf(PlayerException.class);
    }

    @Test
    void thread_startsOnce() {
        client.runThreaded(-1, -1);
        client.runThreaded(-1, -1); // only logs a warning
        assertThat(client.isAlive()).isTrue();
        assertThat(client.isDaemon())
                .as("keeps the JVM alive if the thread that made it does")
                .isEqualTo(Thread.currentThread().isDaemon());
        assertThat(client.readAll()).isZero();
        client.setNotThreaded();
        assertThat(client.isAlive()).isFalse();
        assertThatThrownBy(() -> client.runThreaded(-1, -1)).isInstanceOf(PlayerException.class);
        server.publish(0);
        assertThat(client.readAll()).as("reads by itself again").isEqualTo(PLAYER_MSGTYPE_DATA);
    }

    @Test
    @Tag("threads")
    void runThreaded_fromSeveralThreads_startsOne() throws Exception {
        var inFirst = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var entered = new AtomicInteger();
        var slow = new ScriptedServer() {
            @Override
            public void answered(long tick) {
                entered.incrementAndGet();
                inFirst.countDown();
                try {
                    goOn.await();
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            }
        };
        var failures = new ConcurrentLinkedQueue<Throwable>();
        try (var registration = PlayerPorts.open(ScriptedServer.PORT + 1, slow)) {
            assertThat(registration).isNotNull();
            var robot = new PlayerClient("localhost", ScriptedServer.PORT + 1);
            Runnable run = () -> {
                try {
                    robot.runThreaded(-1, -1);
                } catch (RuntimeException e) {
                    failures.add(e);
                }
            };
            Thread first = Thread.ofPlatform().daemon().start(run);
            inFirst.await();
            Thread second = Thread.ofPlatform().daemon().start(run);
            while (second.getState() != Thread.State.BLOCKED && entered.get() < 2) {
                Thread.onSpinWait();
            }
            goOn.countDown();
            first.join();
            second.join();
            assertThat(failures).isEmpty();
            assertThat(entered).hasValue(1);
            robot.close();
        }
    }

    // ---- on an actor space

    @Test
    void clientOnASpace_seesTheFrameInItsTurn_andAnswersByAskingTwice_andReadAllWouldHoldTheThread() {
        var own = new ScriptedServer();
        var ownPort = PlayerPorts.open(ScriptedServer.PORT + 1, own);
        try (var test = new TestSpace()) {
            var seen = new ArrayList<Object>();
            test.run(() -> {
                var robot = new PlayerClient("localhost", ScriptedServer.PORT + 1);
                var wheels = robot.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                assertThatThrownBy(robot::readAll)
                        .isInstanceOf(PlayerException.class)
                        .hasMessageContaining("use nextData()");
                robot.runThreaded(-1, -1);
                assertThat(robot.isAlive()).isFalse();
                robot.nextData().then(ready -> seen.add(wheels.getX()));
                own.publish(7);
                seen.addAll(List.of(wheels.isDataReady(), wheels.isDataReady(), own.answered()));
                seen.addAll(List.of(wheels.isDataReady(), own.answered()));
            });
            assertThat(seen).contains(7.0).containsSubsequence(true, false, -1L, false, 7L);
        } finally {
            ownPort.close();
        }
    }
}
