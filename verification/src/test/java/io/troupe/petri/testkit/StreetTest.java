package io.troupe.petri.testkit;

import static io.troupe.petri.testkit.WiringAssert.assertThat;
import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.Promise;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.WiringRecorder;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

/** The samples of the guide: tests that are followed and recorded. */
class StreetTest {
    interface Bank {
        Promise<String> pay(Shop shop, int amount);
    }

    interface Shop {
        Promise<String> buy(String what);

        Promise<Integer> price(String what);
    }

    static final class SmallBank implements Bank {
        @Override
        public Promise<String> pay(Shop shop, int amount) {
            return shop.price("lamp").thenApply(price -> price <= amount ? "paid" : "refused");
        }
    }

    static class CornerShop extends Actor implements Shop {
        private final Bank bank;

        CornerShop(Bank bank) {
            this.bank = bank;
        }

        @Override
        public Promise<String> buy(String what) {
            return bank.pay(self(), 5);
        }

        @Override
        public Promise<Integer> price(String what) {
            return Promise.of(5);
        }
    }

    private static final WiringRecorder RECORDER = new WiringRecorder("street");

    @RegisterExtension
    final FollowedActors actors = FollowedActors.recordedBy(RECORDER);

    @TempDir
    static Path folder;

    @Test
    void purchase_isPaid() {
        var test = actors.testSpace();
        Bank bank = test.spawn(Bank.class, SmallBank::new);
        Shop shop = test.spawn(Shop.class, () -> new CornerShop(bank));
        assertThat(test.get(shop.buy("lamp"))).isEqualTo("paid");
    }

    @AfterAll
    static void write() throws IOException {
        Files.writeString(folder.resolve("StreetWiring.java"), RECORDER.java("street", "StreetWiring"));
        assertThat(RECORDER.problems()).isEmpty();
        assertThat(RECORDER.wiring()).cannotDeadlock();
        var ofBank = Protocol.of("bank", Bank.class)
                .state("idle", accepts("pay").then("pay"))
                .state("pay", requests("shop.price").then("pay after shop.price"))
                .state("pay after shop.price", answers("pay").then("idle"))
                .build();
        assertThat(RECORDER.wiring().protocol("bank").states()).isEqualTo(ofBank.states());
        assertThat(RECORDER.wiring().protocol("bank").requested()).isEqualTo(ofBank.requested());
        assertThat(Files.readString(folder.resolve("StreetWiring.java")))
                .contains("accepts(\"pay\").then(\"pay\")")
                .contains("provides(\"price\").then(\"buy waits for bank.pay\")");
    }
}
