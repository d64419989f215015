package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The order in which calls and callbacks of one space run. */
class CallOrderTest {
    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void messages_ofOneSender_keepTheirOrder() {
        interface Notebook {
            void write(String name);

            Promise<List<String>> read();
        }
        Notebook notebook = test.spawn(Notebook.class, () -> new Notebook() {
            private final List<String> names = new ArrayList<>();

            @Override
            public void write(String name) {
                names.add(name);
            }

            @Override
            public Promise<List<String>> read() {
                return Promise.of(List.copyOf(names));
            }
        });
        for (int i = 0; i < 1000; i++) {
            notebook.write("n" + i);
        }
        List<String> names = test.get(notebook.read());
        assertThat(names).hasSize(1000).startsWith("n0", "n1").endsWith("n999");
    }

    @Test
    void call_fromInside_isNeverServedOnTheCallersStack() {
        var log = new ArrayList<String>();
        interface Node {
            void poke();
        }
        Node second = test.spawn(Node.class, () -> () -> log.add("second"));
        Node first = test.spawn(Node.class, () -> () -> {
            log.add("first begins");
            second.poke();
            log.add("first ends");
        });
        first.poke();
        test.crank();
        assertThat(log).containsExactly("first begins", "first ends", "second");
    }

    @Test
    void callback_comesBeforeQueuedMessages() {
        var log = new ArrayList<String>();
        interface Worker {
            Promise<String> work();

            void mail(int number);
        }
        var promise = new Deferred<String>();
        Worker worker = test.spawn(Worker.class, () -> new Worker() {
            @Override
            public Promise<String> work() {
                promise.then(result -> {
                    log.add("callback");
                });
                return promise;
            }

            @Override
            public void mail(int number) {
                log.add("mail " + number);
                if (number == 1) {
                    promise.resolve("done");
                }
            }
        });
        worker.work();
        worker.mail(1);
        worker.mail(2);
        test.crank();
        assertThat(log).containsExactly("mail 1", "callback", "mail 2");
    }

    @Test
    void endlessCallbacks_doNotStarveTheMailbox() {
        var rounds = new int[1];
        var seen = new ArrayList<Integer>();
        interface Worker {
            void spin();

            void mail();
        }
        Worker worker = test.spawn(Worker.class, () -> new Worker() {
            @Override
            public void spin() {
                if (rounds[0]++ < 10_000) {
                    Promise.of(1).then(one -> {
                        spin();
                    });
                }
            }

            @Override
            public void mail() {
                seen.add(rounds[0]);
            }
        });
        test.space().execute(() -> {
            worker.spin();
            worker.mail();
        });
        test.crank();
        assertThat(seen).hasSize(1);
        assertThat(seen.getFirst()).isLessThanOrEqualTo(300);
    }
}
