package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.BusTopic;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.services.subsumption.RobotServices.ServiceEnd;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The robot services as a client of the broker sees them. */
class PublishedRobotServicesTest {
    private static final String WALL_FOLLOWER = Service.WALL_FOLLOWER.name();

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final List<Throwable> failures = new ArrayList<>(); // that the broker reports
    private final RobotServices services = SubsumptionRun.publishAndConnect(
            test.space(),
            () -> new RobotServicesActor(RobotServicesActor.Settings.ofThePaper()
                    .withPort(FakeRobots.PORT)
                    .withObserver(charge)),
            failures::add);

    @AfterEach
    void nothingIsLeft() {
        test.crank();
        assertThat(failures).isEmpty();
        test.close();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
    }

    @Test
    void callThatIsCancelledWhileItIsQueued_hasNoEffect() {
        services.drive(0, WALL_FOLLOWER, NamedColours.BLUE).cancel();
        test.crank();
        robots.tick(100);
        assertThat(robots.connections()).isZero();
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void errors_areThoseOfTheServices() {
        assertThat(test.error(services.drive(7, WALL_FOLLOWER, NamedColours.BLUE)))
                .isExactlyInstanceOf(PlayerException.class)
                .hasMessageContaining("position2d:7 is not in the device list");
        assertThat(test.error(services.drive(0, "none", NamedColours.BLUE)))
                .isExactlyInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith("there is no service none");
    }

    /** Values could leave the process; a bus over hosts would have to carry the callback. */
    @Test
    void argumentsAndAnswers_areValues_exceptTheCallback() {
        assertThatCode(() -> new BusTopic<>("reports", ColourReport.class)).doesNotThrowAnyException();
        assertThatCode(() -> new BusTopic<>("ends", ServiceEnd.class)).doesNotThrowAnyException();
        assertThat(RobotServices.class.getMethods())
                .flatExtracting(method -> Arrays.asList(method.getParameterTypes()))
                .extracting(Object::toString)
                .containsOnly("int", "class java.lang.String", "interface io.troupe.actor.Callback");
    }
}
