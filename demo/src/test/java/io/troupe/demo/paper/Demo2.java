package io.troupe.demo.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;

/**
 * The main code of the paper in callback mode: Figure 17 for state 1, and the same for states 2 and 3, which the paper
 * does not print. The changes are listed in {@code docs/guide/02-the-papers-code.md}; [n] marks the lines of that list.
 */
public class Demo2 extends Actor {
    private final PaperServices robot1; // [1] two references to the services class, made as actors
    private final PaperServices robot2;
    private final List<String> printed; // [2] instead of System.out, so that a test can read it
    private final AtomicReference<Integer> atomicRefWF1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefSW1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefBF1 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefWF2 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefSW2 = new AtomicReference<>(2);
    private final AtomicReference<Integer> atomicRefBF2 = new AtomicReference<>(2);
    private int color2 = 255;

    Demo2(PaperServices robot1, PaperServices robot2, List<String> printed) {
        this.robot1 = robot1;
        this.robot2 = robot2;
        this.printed = printed;
    }

    public void live() {
        if (color2 == 255) {
            printed.add("State 1");
            // [3] while(!(atomicRefSW2.get()==2)); is a promise in stopAll()
            atomicRefWF1.set(1);

            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            robot2.spaceWanderer(
                    (ch, err) -> {
                        if (failed(err) || color2 != 255) { // [4]
                            return;
                        }
                        // [5] color2 = (int) ch comes after the check
                        if (ch != 255 && ch != 16753920) {
                            color2 = (int) ch;
                            printed.add("received color " + color2);
                            atomicRefWF1.set(0);
                            atomicRefSW2.set(0);
                            atomicRefBF2.set(0);
                            stopAll().thenRun(() -> ((Demo2) self()).live());
                        }
                    },
                    1,
                    atomicRefSW2,
                    atomicRefBF2);
            robot1.wallFollower(0, atomicRefWF1);
        } else if (color2 == 16711680) {
            printed.add("State 2");
            atomicRefWF2.set(1);

            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            var references = List.of(atomicRefWF2, atomicRefSW1, atomicRefBF1);
            robot1.spaceWanderer((ch, err) -> leave(16711680, ch, err, references), 0, atomicRefSW1, atomicRefBF1);
            robot2.wallFollower(1, atomicRefWF2);
        } else if (color2 == 65280) {
            printed.add("State 3");
            atomicRefSW1.set(1);
            atomicRefBF1.set(1);
            atomicRefSW2.set(1);
            atomicRefBF2.set(1);
            var references = List.of(atomicRefSW1, atomicRefBF1, atomicRefSW2, atomicRefBF2);
            robot1.spaceWanderer((ch, err) -> leave(65280, ch, err, references), 0, atomicRefSW1, atomicRefBF1);
            robot2.spaceWanderer((ch, err) -> leave(65280, ch, err, references), 1, atomicRefSW2, atomicRefBF2);
        }
    }

    /** States 2 and 3 end as state 1 does. */
    private void leave(int state, Integer ch, Throwable err, List<AtomicReference<Integer>> references) {
        if (failed(err) || color2 != state) {
            return;
        }
        if (ch != state && ch != 16753920) {
            color2 = (int) ch;
            printed.add("received color " + color2);
            references.forEach(reference -> reference.set(0));
            stopAll().thenRun(() -> ((Demo2) self()).live());
        }
    }

    /**
     * [4] Failures must be handled; and a message that arrives after the colour that ended the state must not call
     * live() again.
     */
    private static boolean failed(Throwable err) {
        if (err != null) {
            throw new IllegalStateException("a service failed", err);
        }
        return false;
    }

    /**
     * [3] Fulfilled when every reference is 2. A busy loop would block the only thread, on which the services set the
     * references.
     */
    private Promise<?> stopAll() {
        return Promise.all(List.of(
                robot1.stop(atomicRefWF1),
                robot1.stop(atomicRefSW1),
                robot2.stop(atomicRefWF2),
                robot2.stop(atomicRefSW2)));
    }
}
