package io.troupe.actor.kotlin.guide

import io.troupe.petri.wiring.Protocol
import io.troupe.petri.wiring.Protocol.does
import io.troupe.petri.wiring.Protocol.provides
import io.troupe.petri.wiring.Protocol.requests
import io.troupe.petri.wiring.Wiring

/** Recorded from runs: a draft. */
internal object PurseWiring {
    fun wiring(): Wiring {
        val ofBank = Protocol.of("bank", io.troupe.actor.kotlin.guide.GuideTest.Bank::class.java)
            .state(
                "idle",
                provides("confirm").then("idle"))
            .build()
        val ofPurse = Protocol.of("purse", io.troupe.actor.kotlin.guide.GuideTest.Purse::class.java)
            .state(
                "idle",
                does("paySafely from outside").then("paySafely"))
            .state(
                "paySafely",
                requests("bank.confirm").then("paySafely after bank.confirm"),
                does("answers paySafely").then("idle"))
            .state(
                "paySafely after bank.confirm",
                does("answers paySafely").then("idle"))
            .build()
        return Wiring.of("purse")
            .component("bank", ofBank)
            .component("purse", ofPurse)
            .build()
    }
}
