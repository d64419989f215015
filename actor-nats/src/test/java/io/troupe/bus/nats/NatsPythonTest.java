package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A node in Python, {@code docs/examples/python/troupe_peer.py}, beside one in Java. */
@Tag("threads")
@Timeout(value = 180, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class NatsPythonTest {
    record Sonar(List<Double> rangesM) {}

    record Velocity(double forwardMps, double turnRadps) {}

    record Cell(int cell) {}

    record Charge(double percent) {}

    record Report(String text) {}

    private static final BusTopic<Sonar> SONAR = new BusTopic<>("robot1/sonar", Sonar.class);
    private static final BusTopic<Velocity> DRIVE = new BusTopic<>("robot1/drive", Velocity.class);
    private static final Operation<Cell, Charge> CHARGE =
            new Operation<>("charge", Cell.class, Charge.class, Operation.Kind.DATA);
    private static final Operation<Cell, Report> INSPECT =
            new Operation<>("inspect", Cell.class, Report.class, Operation.Kind.DATA);
    private static final Duration LONG = Duration.ofSeconds(60);
    private static final Path PEER = Path.of("../docs/examples/python/troupe_peer.py");

    @Test
    void nodeInPython_publishesAndSubscribes_asksAndAnswers() throws Exception {
        String python = python();
        try (var server = NatsServer.start();
                var space = ActorSpace.create(SpaceSettings.named("beside python"));
                var bus = NatsBus.open("robot", server.settings(), BusSettings.on(space))) {
            var peer = new ProcessBuilder(python, PEER.toString(), server.address())
                    .redirectErrorStream(true)
                    .start();
            try {
                assertThat(peer.inputReader().readLine()).isEqualTo("ready");
                steersByTheSonar(bus);
                handlesARequest_andSendsTwo(bus);
                hasItsNameAlone(server, space);
            } finally {
                peer.destroyForcibly().waitFor();
            }
        }
    }

    private static void steersByTheSonar(Bus bus) throws InterruptedException {
        var port = bus.attach("sonar");
        var velocities = new LinkedBlockingQueue<Velocity>();
        port.subscribe(DRIVE, (velocity, from) -> velocities.add(velocity));
        port.publish(SONAR, new Sonar(List.of(2.0, 0.75, 1.5)));
        assertThat(velocities.poll(60, TimeUnit.SECONDS)).isEqualTo(new Velocity(0.2, 0));
        port.publish(SONAR, new Sonar(List.of(2.0, 0.25)));
        assertThat(velocities.poll(60, TimeUnit.SECONDS)).isEqualTo(new Velocity(0, 0.6));
    }

    private static void handlesARequest_andSendsTwo(Bus bus) throws Exception {
        var battery = bus.attach("battery");
        battery.answer(CHARGE, cell -> Promise.of(new Charge(cell.cell() * 10.5)));
        var driver = new Address("python", "driver");
        assertThat(battery.ask(driver, INSPECT, new Cell(8), LONG).get(LONG).text())
                .isEqualTo("cell 8 has 84.0 percent; arm: no node of that name is connected now");
        assertThatThrownBy(() -> battery.ask(driver, CHARGE, new Cell(1), LONG).get(LONG))
                .isInstanceOf(BusException.class)
                .hasMessageEndingWith("asked python/driver for charge: python/driver does not answer that");
    }

    private static void hasItsNameAlone(NatsServer server, ActorSpace space) {
        assertThatThrownBy(() -> NatsBus.open("python", server.settings(), BusSettings.on(space)))
                .isInstanceOf(BusException.class)
                .hasMessageStartingWith("node python cannot be opened: another process has that name on ");
    }

    /**
     * An interpreter with the packages of the peer; skips the test, with one line that gives the reason, if there is
     * none.
     */
    private static String python() throws InterruptedException {
        String python = System.getProperty("troupe.python", "python3");
        boolean hasPackages;
        try {
            hasPackages = new ProcessBuilder(python, "-c", "import nats, cbor2")
                            .redirectError(ProcessBuilder.Redirect.DISCARD)
                            .start()
                            .waitFor()
                    == 0;
        } catch (IOException none) {
            hasPackages = false;
        }
        assumeTrue(
                hasPackages,
                python + " has no nats-py and cbor2 (pip install nats-py cbor2, or -Dtroupe.python=..): not tested");
        return python;
    }
}
