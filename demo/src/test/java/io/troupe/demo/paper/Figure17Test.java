package io.troupe.demo.paper;

import static io.troupe.demo.paper.Drives.drive;
import static io.troupe.demo.paper.Drives.services;
import static io.troupe.demo.paper.Drives.stamped;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.CallbackArbitrator;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Tests that the paper's main code in callback mode drives the robots like our own arbitrator. */
@Timeout(120)
class Figure17Test {
    @Test
    void demo2_goesThroughAllThreeStates_asTheCallbackArbitratorDoes() {
        var ofThePaper = new ArrayList<String>();
        drive(space -> {
            RobotServices robot1 = services(space);
            RobotServices robot2 = services(space);
            Demo2 demo = space.spawn(Demo2.class, () -> new Demo2(robot1, robot2, stamped(space.clock(), ofThePaper)));
            demo.live();
        });
        var ours = new ArrayList<String>();
        drive(space -> {
            RobotServices services = services(space);
            var printer = Drives.printer("received color ", stamped(space.clock(), ours));
            CallbackArbitrator arbitrator = space.spawn(
                    CallbackArbitrator.class,
                    () -> new CallbackArbitrator(services, SubsumptionTable.ofThePaper(), printer));
            arbitrator.live();
        });
        Drives.assertAllThreeStates(ofThePaper);
        assertThat(ofThePaper).isEqualTo(ours);
    }
}
