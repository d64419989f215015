package io.troupe.actor.model;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.Supervision;
import io.troupe.actor.Supervision.Directive;
import java.time.Duration;

/**
 * The settings of an actor of a program, as plain numbers.
 *
 * @param limit failures within the window; -1 = any number
 * @param windowTicks in half milliseconds
 * @param capacity of the mailbox; 0 = any
 * @param failingInstance the instance whose factory throws; 0 = none
 */
record Cast(
        Directive directive,
        int limit,
        int windowTicks,
        int capacity,
        Overflow overflow,
        boolean ownHandler,
        int failingInstance) {
    static final int VARIANTS = 5 * 6 * 2 * 4;

    static Cast of(int variant) {
        int supervision = variant % 5;
        int mailbox = variant / 5 % 6;
        int factory = variant / 60 % 4;
        return new Cast(
                switch (supervision) {
                    case 1 -> Directive.STOP;
                    case 2, 3 -> Directive.RESTART;
                    default -> Directive.RESUME;
                },
                supervision < 2 ? -1 : Math.min(1, supervision - 2),
                10,
                mailbox < 3 ? 0 : 2,
                Overflow.values()[mailbox % 3],
                variant / 30 % 2 == 1,
                factory < 2 ? 0 : factory - 1);
    }

    ActorSettings settings(String name) {
        int most = limit < 0 ? Integer.MAX_VALUE : limit;
        var plain = ActorSettings.named(name).withSupervision(new Supervision(directive, most, ticks(windowTicks)));
        return capacity == 0 ? plain : plain.withMailbox(capacity, overflow);
    }

    static Duration ticks(int number) {
        return Duration.ofNanos(500_000L * number);
    }
}
