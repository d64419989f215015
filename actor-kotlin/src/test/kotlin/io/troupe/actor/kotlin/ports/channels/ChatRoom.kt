package io.troupe.actor.kotlin.ports.channels

import io.troupe.actor.kotlin.ports.ChatRoom
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.ObsoleteCoroutinesApi
import kotlinx.coroutines.channels.Channel
import kotlinx.coroutines.channels.SendChannel
import kotlinx.coroutines.channels.actor
import kotlinx.coroutines.flow.Flow
import kotlinx.coroutines.flow.flow

private sealed interface ChatMessage

private class Enter(val name: String, val inbox: SendChannel<String>) : ChatMessage

private class Leave(val name: String, val inbox: SendChannel<String>) : ChatMessage

private class Say(val name: String, val line: String, val reached: CompletableDeferred<Int>) : ChatMessage

@OptIn(ObsoleteCoroutinesApi::class)
fun chatRoom(scope: CoroutineScope): ChatRoom {
    val mailbox = scope.actor<ChatMessage>(capacity = Channel.UNLIMITED) {
        val members = mutableMapOf<String, SendChannel<String>>()
        for (message in channel) {
            when (message) {
                is Enter -> members[message.name] = message.inbox
                is Leave -> members.remove(message.name, message.inbox)
                is Say -> {
                    val others = members - message.name
                    others.values.forEach { it.trySend("${message.name}: ${message.line}") }
                    message.reached.complete(others.size)
                }
            }
        }
    }
    return object : ChatRoom {
        override fun join(name: String): Flow<String> = flow {
            val inbox = Channel<String>(Channel.UNLIMITED)
            mailbox.send(Enter(name, inbox))
            try {
                for (line in inbox) emit(line)
            } finally {
                mailbox.trySend(Leave(name, inbox))
            }
        }

        override suspend fun say(name: String, line: String): Int {
            val reached = CompletableDeferred<Int>()
            mailbox.send(Say(name, line, reached))
            return reached.await()
        }
    }
}
