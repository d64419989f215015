package io.troupe.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;

/**
 * The main code of the paper in callback mode: Figure 17 for state 1, and the same for states 2 and 3, which the paper
 * does not print. The changes are listed in {@code docs/guide/02-the-papers-code.md}; [n] marks the lines of that list.
 */
public class Demo2 extends Actor {
    private final PaperServices robot1; // two references to the services class, made as actors
    private final PaperServices robot2;
    private final AtomicReference<Integer> atomicRefWF1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefSW1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefBF1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefWF2 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefSW2 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefBF2 = new AtomicReference<>(2);
    private int color2 = 255;

    public static void main(String[] args) {
        PaperRobots.drive(args, 3, robots -> robots.driveByActors(space -> start(space, robots.host(), robots.port())));
    }

    static List<Actor> start(ActorSpace space, String host, int port) {
        PaperServices robot1 = space.spawn(PaperServices.class, () -> new PaperServices(host, port));
        PaperServices robot2 = space.spawn(PaperServices.class, () -> new PaperServices(host, port));
        Demo2 demo = space.spawn(Demo2.class, () -> new Demo2(robot1, robot2));
        demo.live();
        return List.of(demo, robot1, robot2);
    }

    Demo2(PaperServices robot1, PaperServices robot2) {
        this.robot1 = robot1;
        this.robot2 = robot2;
    }

    public void live() {
        if (color2 == 255) {
            System.out.println("State 1");
            // [1] while(!(atomicRefSW2.get()==2));
            atomicRefWF1.set(1);

            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(
                    (ch, err) -> {
                        color2 = (int) ch;
                        System.out.println(color2);
                        System.out.println("received color " + System.currentTimeMillis());
                        if (color2 != 255 && color2 != 16753920) {
                            atomicRefWF1.set(0);
                            atomicRefSW2.set(0);
                            atomicRefBF2.set(0);
                            ((Demo2) self()).live();
                        }
                    },
                    1,
                    atomicRefSW2,
                    atomicRefBF2);
            robot1.wallFollower(0, atomicRefWF1);
        } else if (color2 == 16711680) {
            System.out.println("State 2");
            atomicRefWF2.set(1);

            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            robot1.spaceWanderer(
                    (ch, err) -> {
                        color2 = (int) ch;
                        System.out.println(color2);
                        System.out.println("received color " + System.currentTimeMillis());
                        if (color2 != 16711680 && color2 != 16753920) {
                            atomicRefWF2.set(0);
                            atomicRefSW1.set(0);
                            atomicRefBF1.set(0);
                            ((Demo2) self()).live();
                        }
                    },
                    0,
                    atomicRefSW1,
                    atomicRefBF1);
            robot2.wallFollower(1, atomicRefWF2);
        } else if (color2 == 65280) {
            System.out.println("State 3");
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot1.spaceWanderer((ch, err) -> receiveInState3((int) ch), 0, atomicRefSW1, atomicRefBF1);
            robot2.spaceWanderer((ch, err) -> receiveInState3((int) ch), 1, atomicRefSW2, atomicRefBF2);
        }
    }

    private void receiveInState3(int ch) {
        if (atomicRefSW1.get() == 0) {
            return; // both wanderers have seen a colour in the same reading: the first one has ended the state
        }
        color2 = ch;
        System.out.println(color2);
        System.out.println("received color " + System.currentTimeMillis());
        if (color2 != 65280 && color2 != 16753920) {
            atomicRefSW1.set(0);
            atomicRefBF1.set(0);
            atomicRefSW2.set(0);
            atomicRefBF2.set(0);
            ((Demo2) self()).live();
        }
    }
}
