package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.SimulationRunner;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Clients in pull mode, in lock step with the world. */
@Timeout(60)
class PullTest {
    private static final int FRAMES = 200;

    /** Drives in curves for a while; returns everything that the server has sent. */
    private static byte[] run(Served served) throws WireException {
        try (var runner = SimulationRunner.start(served.simulation, 1, snapshot -> {});
                var client = RawClient.greeted(served.port())) {
            assertThat(runner.isRunning()).isTrue();
            client.ask(new PlayerRequest.DataMode(Delivery.PULL));
            client.subscribe(Interfaces.POSITION2D);
            client.subscribe(Interfaces.SONAR);
            client.subscribe(Interfaces.BLOBFINDER);
            for (int frame = 0; frame < FRAMES; frame++) {
                client.ask(new PlayerRequest.NextData());
                DeviceData.Position2d position = client.nextPosition();
                client.next(MessageType.DATA, 5, 1);
                client.next(MessageType.DATA, 7, 1);
                client.next(MessageType.SYNCH, 1, 1);
                client.drive(0.3, Math.sin(frame) - position.pa());
            }
            return client.received();
        }
    }

    @Test
    void lockStep_twice_givesTheSameBytes() throws WireException {
        byte[] first;
        int port;
        try (var served = Served.open()) {
            port = served.port();
            first = run(served);
        }
        try (var served = Served.open(port)) {
            byte[] second = run(served);
            assertThat(Hex.text(second)).isEqualTo(Hex.text(first));
        }
    }

    @Test
    void everyTick_isSeenOnce() throws WireException {
        try (var served = Served.open()) {
            byte[] said = run(served);
            var in = new ByteArrayInputStream(said, 32, said.length - 32);
            var reader = new MessageReader(in, 1 << 16);
            int tick = 0;
            while (in.available() > 0) {
                WireMessage message = reader.read();
                if (message.header().type() == MessageType.DATA
                        && message.header().address().interfaceCode() == 4) {
                    assertThat(message.header().timeSeconds()).isEqualTo(tick++ / 10.0);
                }
            }
            assertThat(tick).isEqualTo(FRAMES);
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    @Test
    void rulesThatLeaveNothing_leaveTheEndOfEachFrame_whichHasToBeAnswered() {
        try (var served = Served.open();
                var runner = SimulationRunner.start(served.simulation, 1, snapshot -> {});
                var client = RawClient.greeted(served.port())) {
            client.ask(new PlayerRequest.DataMode(Delivery.PULL));
            client.ask(new PlayerRequest.AddRule(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE)));
            client.subscribe(Interfaces.POSITION2D);
            for (int frame = 0; frame < 20; frame++) {
                client.ask(new PlayerRequest.NextData());
                client.next(MessageType.SYNCH, 1, 1);
                // every reply has the time of the newest frame: the world waits for this client's answer
                assertThat(client.ask(new PlayerRequest.DeviceList()).header().timeSeconds())
                        .isEqualTo(frame / 10.0);
            }
            client.ask(new PlayerRequest.AddRule(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.ACCEPT)));
            client.ask(new PlayerRequest.NextData());
            assertThat(client.next(MessageType.DATA, 4, 1).header().timeSeconds())
                    .isEqualTo(2.0);
            client.next(MessageType.SYNCH, 1, 1);
            assertThat(runner.isRunning()).isTrue();
        }
    }
}
