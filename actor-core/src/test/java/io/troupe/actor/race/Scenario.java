package io.troupe.actor.race;

/** The subject of a round. */
enum Scenario {
    PROMISES(PromiseRaces::listeners),
    CALLS_AND_CLOSE(CallRaces::close),
    CALLS_AND_RESTART(CallRaces::restart),
    BOUNDED_MAILBOXES(CallRaces::bounds),
    ASKS_AFTER_SILENCE(ChainRaces::silence),
    CHAINS_AND_BODIES(ChainRaces::chains),
    TOPICS_AND_STREAMS(StreamRaces::play),
    TIME_LIMITS(TimerRaces::play),
    END_OF_THE_STACK(ErrorRaces::endOfTheStack),
    FATAL_ERRORS(ErrorRaces::fatalErrors);

    /** Runs a round. */
    interface Play {
        void accept(Round round) throws Exception;
    }

    private final Play play;

    Scenario(Play play) {
        this.play = play;
    }

    void play(Round round) throws Exception {
        play.accept(round);
    }
}
