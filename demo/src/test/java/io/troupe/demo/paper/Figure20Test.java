package io.troupe.demo.paper;

import static io.troupe.demo.paper.ArenaRun.drive;
import static io.troupe.demo.paper.ArenaRun.paperServices;
import static io.troupe.demo.paper.ArenaRun.stamped;
import static io.troupe.demo.paper.ArenaRun.startOurs;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Mode;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The paper's main code in promise mode drives the robots with the same result as our arbitrator. */
@Timeout(120)
class Figure20Test {
    @Test
    void demo3_goesThroughAllThreeStates_asTheArbitratorDoes() {
        var ofThePaper = new ArrayList<String>();
        drive(space -> {
            PaperServices robot1 = paperServices(space);
            PaperServices robot2 = paperServices(space);
            Demo3 demo = space.spawn(Demo3.class, () -> new Demo3(robot1, robot2, stamped(space.clock(), ofThePaper)));
            demo.live();
        });
        var ours = new ArrayList<String>();
        drive(space -> startOurs(space, Mode.PROMISE, ArenaRun.printer("color", stamped(space.clock(), ours))));
        ArenaRun.assertAllThreeStates(ofThePaper);
        assertThat(ofThePaper).isEqualTo(ours);
    }
}
