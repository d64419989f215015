package io.troupe.demo.paper;

import io.troupe.actor.Actor;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;

/**
 * The main code of the paper in promise mode: Figure 20 for state 1, and the same for states 2 and 3, which the paper
 * does not print. The changes are listed in {@code docs/guide/02-the-papers-code.md}; [n] marks the lines of that list.
 */
public class Demo3 extends Actor {
    private final PaperServices robot1; // [1] two references to the services class, made as actors
    private final PaperServices robot2;
    private final List<String> printed; // [2] instead of System.out, so that a test can read it
    private final AtomicReference<Integer> atomicRefWF1 = new AtomicReference<>(0);
    private AtomicReference<Integer> atomicRefSW1 = new AtomicReference<>(0);
    private AtomicReference<Integer> atomicRefBF1 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefWF2 = new AtomicReference<>(0);
    private AtomicReference<Integer> atomicRefSW2 = new AtomicReference<>(0);
    private AtomicReference<Integer> atomicRefBF2 = new AtomicReference<>(0);
    private int color2 = 255;

    Demo3(PaperServices robot1, PaperServices robot2, List<String> printed) {
        this.robot1 = robot1;
        this.robot2 = robot2;
        this.printed = printed;
    }

    public void live() {
        if (color2 == 255) {
            printed.add("State 1");
            atomicRefWF1.set(1);
            robot1.wallFollower(0, atomicRefWF1);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(1, atomicRefSW2, atomicRefBF2, 255).then(result -> {
                color2 = result;
                printed.add("color" + color2);

                atomicRefWF1.set(0); // [3] stated in the paper's text, missing in its figure
                atomicRefSW2.set(0);
                atomicRefBF2.set(0);
                ((Demo3) self()).live();
            });
        } else if (color2 == 16711680) {
            printed.add("State 2");
            atomicRefWF2.set(1);
            robot2.wallFollower(1, atomicRefWF2);
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            robot1.spaceWanderer(0, atomicRefSW1, atomicRefBF1, 16711680).then(result -> {
                color2 = result;
                printed.add("color" + color2);

                atomicRefWF2.set(0);
                atomicRefSW1.set(0);
                atomicRefBF1.set(0);
                ((Demo3) self()).live();
            });
        } else if (color2 == 65280) {
            printed.add("State 3");
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            robot1.spaceWanderer(0, atomicRefSW1, atomicRefBF1, 65280).then(this::leaveState3);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(1, atomicRefSW2, atomicRefBF2, 65280).then(this::leaveState3);
        }
    }

    /** [4] Two wanderers return two promises. The second result must not call live() again. */
    private void leaveState3(int result) {
        if (color2 != 65280 || result == 65280) {
            return;
        }
        color2 = result;
        printed.add("color" + color2);

        atomicRefSW1.set(0);
        atomicRefBF1.set(0);
        atomicRefSW2.set(0);
        atomicRefBF2.set(0);
        atomicRefSW1 =
                new AtomicReference<>(0); // [5] one of them may still change from 0 to 2: do not set it to 1 again
        atomicRefBF1 = new AtomicReference<>(0);
        atomicRefSW2 = new AtomicReference<>(0);
        atomicRefBF2 = new AtomicReference<>(0);
        ((Demo3) self()).live();
    }
}
