package io.troupe.demo.paper;

import static io.troupe.demo.paper.Drives.drive;
import static io.troupe.demo.paper.Drives.services;
import static io.troupe.demo.paper.Drives.stamped;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Tests that the paper's main code in promise mode drives the robots like our own arbitrator. */
@Timeout(120)
class Figure20Test {
    @Test
    void demo3_goesThroughAllThreeStates_asTheArbitratorDoes() {
        var ofThePaper = new ArrayList<String>();
        drive(space -> {
            RobotServices robot1 = services(space);
            RobotServices robot2 = services(space);
            Demo3 demo = space.spawn(Demo3.class, () -> new Demo3(robot1, robot2, stamped(space.clock(), ofThePaper)));
            demo.live();
        });
        var ours = new ArrayList<String>();
        drive(space -> {
            RobotServices services = services(space);
            var printer = Drives.printer("color", stamped(space.clock(), ours));
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class, () -> new Arbitrator(services, SubsumptionTable.ofThePaper(), printer));
            arbitrator.live();
        });
        Drives.assertAllThreeStates(ofThePaper);
        assertThat(ofThePaper).isEqualTo(ours);
    }
}
