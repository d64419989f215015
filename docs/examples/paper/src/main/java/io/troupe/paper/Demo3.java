package io.troupe.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;

/**
 * The main code of the paper in promise mode: Figure 20 for state 1, and the same for states 2 and 3, which the paper
 * does not print. See {@code docs/guide/02-the-papers-code.md}.
 */
public class Demo3 extends Actor {
    private final PaperServices robot1; // two references to the services class, made as actors
    private final PaperServices robot2;
    private final AtomicReference<Integer> atomicRefWF1 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefSW1 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefBF1 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefWF2 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefSW2 = new AtomicReference<>(0);
    private final AtomicReference<Integer> atomicRefBF2 = new AtomicReference<>(0);
    private int color2 = 255;

    public static void main(String[] args) {
        PaperRobots.drive(args, 3, robots -> robots.driveByActors(space -> start(space, robots.host(), robots.port())));
    }

    static List<Actor> start(ActorSpace space, String host, int port) {
        PaperServices robot1 = space.spawn(PaperServices.class, () -> new PaperServices(host, port));
        PaperServices robot2 = space.spawn(PaperServices.class, () -> new PaperServices(host, port));
        Demo3 demo = space.spawn(Demo3.class, () -> new Demo3(robot1, robot2));
        demo.live();
        return List.of(demo, robot1, robot2);
    }

    Demo3(PaperServices robot1, PaperServices robot2) {
        this.robot1 = robot1;
        this.robot2 = robot2;
    }

    public void live() {
        if (color2 == 255) {
            System.out.println("State 1");
            atomicRefWF1.set(1);
            robot1.wallFollower(0, atomicRefWF1);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(1, atomicRefSW2, atomicRefBF2, 255).then(result -> {
                color2 = result;
                System.out.println("color" + color2);

                atomicRefSW2.set(0);
                atomicRefBF2.set(0);
                ((Demo3) self()).live();
            });
        } else if (color2 == 16711680) {
            System.out.println("State 2");
            atomicRefWF2.set(1);
            robot2.wallFollower(1, atomicRefWF2);
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            robot1.spaceWanderer(0, atomicRefSW1, atomicRefBF1, 16711680).then(result -> {
                color2 = result;
                System.out.println("color" + color2);

                atomicRefSW1.set(0);
                atomicRefBF1.set(0);
                ((Demo3) self()).live();
            });
        } else if (color2 == 65280) {
            System.out.println("State 3");
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            robot1.spaceWanderer(0, atomicRefSW1, atomicRefBF1, 65280).then(this::leaveState3);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(1, atomicRefSW2, atomicRefBF2, 65280).then(this::leaveState3);
        }
    }

    /** Two wanderers return two promises: the second result is ignored. */
    private void leaveState3(int result) {
        if (color2 != 65280) {
            return;
        }
        color2 = result;
        System.out.println("color" + color2);

        atomicRefSW1.set(0);
        atomicRefBF1.set(0);
        atomicRefSW2.set(0);
        atomicRefBF2.set(0);
        ((Demo3) self()).live();
    }
}
