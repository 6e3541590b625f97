using System;
using System.Collections.Concurrent;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Where code goes on that awaits an answer of a <see cref="PeerThread"/>, as GAMELOOP says: on an engine's main thread if that has a context, as in Unity and
/// Godot; on a thread of the pool otherwise. Frames as in the pages stay on their own in both.</summary>
[Trait("Time", "real")]
public sealed class AnswerThreadTests
{
    private static readonly PlayerAction Push = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0));

    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    [Theory]
    [InlineData(true)]
    [InlineData(false)] // the control
    public void DoAndAsk_Awaited_GoOnOnTheThreadOfTheContextIfThereIsOne(bool hasContext)
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        Assert.True(host.WaitUntilRunning(Deadline));
        using Engine engine = new(hasContext);
        foreach (Func<Task> asked in new Func<Task>[] { () => host.Do(Push).AsTask(), () => host.Ask(session => session.State) })
        {
            int before = 0, after = 0;
            using ManualResetEventSlim isAwaited = new();
            _ = host.Ask(_ => isAwaited.Wait(Deadline)); // an answer that is there already needs no other thread
            engine.Run(
                async () =>
                {
                    before = Environment.CurrentManagedThreadId;
                    await asked();
                    after = Environment.CurrentManagedThreadId;
                },
                isAwaited.Set);
            Assert.Equal(engine.ThreadId, before);
            Assert.Equal(hasContext, after == before);
        }
    }

    /// <summary>Frames that discard the task, or look at it later, read and act on one thread with or without a context.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Do_InFramesAsInThePages_StaysOnTheThreadThatDraws(bool hasContext)
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        using Engine engine = new(hasContext);
        Task<ExternalEvent>? shot = null;
        BodyId bullet = default;
        int other = 0;
        Assert.True(engine.Frames(Deadline, () =>
        {
            other += Environment.CurrentManagedThreadId == engine.ThreadId ? 0 : 1;
            if (host.State != SessionState.Running || host.Latest() is not RenderSnapshot)
            {
                return false;
            }

            _ = host.Do(Push);
            shot ??= host.Do(PlayerAction.Spawn(new BodySpec(0.5, 1, 1), new Vector3D(0, 50, 0))).AsTask();
            bullet = shot.IsCompletedSuccessfully ? shot.Result.Body : default;
            return bullet.Sequence > 0;
        }));
        Assert.Equal(0, other);
    }

    /// <summary>A thread that runs frames, and whose context, if it has one, runs between them what was posted to it.</summary>
    private sealed class Engine : SynchronizationContext, IDisposable
    {
        private readonly BlockingCollection<(SendOrPostCallback Call, object? State)> posted = [];
        private readonly Thread thread;

        internal Engine(bool hasContext)
        {
            thread = new Thread(() =>
            {
                SetSynchronizationContext(hasContext ? this : null);
                foreach ((SendOrPostCallback call, object? state) in posted.GetConsumingEnumerable())
                {
                    call(state);
                }
            })
            { IsBackground = true };
            thread.Start();
        }

        internal int ThreadId => thread.ManagedThreadId;

        public override void Post(SendOrPostCallback d, object? state) => posted.Add((d, state));

        public void Dispose()
        {
            posted.CompleteAdding();
            thread.Join();
            posted.Dispose();
        }

        /// <summary>Runs something of the game to its end.</summary>
        /// <param name="game">It.</param>
        /// <param name="awaits">Called once it has come to its first await.</param>
        internal void Run(Func<Task> game, Action? awaits = null)
        {
            TaskCompletionSource<Task> begun = new(TaskCreationOptions.RunContinuationsAsynchronously);
            Post(_ => begun.SetResult(game()), null);
            Assert.True(begun.Task.Wait(Deadline));
            awaits?.Invoke();
            Assert.True(begun.Task.Result.Wait(Deadline));
        }

        internal bool Frames(TimeSpan atMost, Func<bool> frame)
        {
            bool isDone = false;
            return SpinWait.SpinUntil(
                () =>
                {
                    Run(() =>
                    {
                        isDone = frame();
                        return Task.CompletedTask;
                    });
                    return isDone;
                },
                atMost);
        }
    }
}
