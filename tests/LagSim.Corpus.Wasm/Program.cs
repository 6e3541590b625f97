using System;
using System.Threading.Tasks;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;

namespace LagSim.Corpus;

/// <summary>
/// LagSim.Corpus for one thread: <c>FOLDER</c> replays a folder of recordings; <c>--host</c> and <c>--join ADDRESS</c> play one end of a
/// protected session.
/// </summary>
internal static class Program
{
    private static async Task<int> Main(string[] arguments) => arguments switch
    {
        ["--host"] => await Host(),
        ["--join", string address] => await Join(HostAddress.Parse(address)),
        [string folder] => CorpusCheck.Run(folder, Console.Out),
        _ => throw new ArgumentException($"'{string.Join(' ', arguments)}' must be FOLDER, --host, or --join ADDRESS."),
    };

    private static async Task<int> Host()
    {
        using HostIdentity identity = HostIdentity.Draw();
        using NodePort port = new();
        HostSession host = new(SecureSession.Scene, port, new StopwatchClock(), SecureSession.Hosting(identity), 1);
        bool isOver = false;
        host.ClientGone += _ => isOver = true;
        SecureSession.Watch(host, Console.Out);
        Console.WriteLine(new HostAddress("127.0.0.1", port.LocalAddress.ToEndPoint().Port, identity.Fingerprint));
        return await Run(host, () => isOver) && host.Counters.DatagramsForged == 0 ? 0 : 1;
    }

    private static async Task<int> Join(HostAddress address)
    {
        using NodePort port = new();
        PeerAddress there = PeerAddress.From(SecureSession.EndPoint(address));
        ClientSession client = new(null, port, new StopwatchClock(), SecureSession.Joining(address), there, 1);
        SecureSession.Watch(client, Console.Out);
        if (!await Run(client, () => client.State == SessionState.Running))
        {
            return 1;
        }

        long agreedBefore = client.Counters.StatesAgreed;
        client.Do(SecureSession.Kick);
        await Run(client, () => SecureSession.IsEnough(client.Counters, agreedBefore));
        client.Leave();
        await Run(client, () => client.State == SessionState.Ended);
        return SecureSession.Judge(client.Counters, agreedBefore, Console.Out);
    }

    /// <summary>Steps a session from the one thread there is, until something holds; false if it ends or takes too long.</summary>
    private static async Task<bool> Run(Session session, Func<bool> until)
    {
        DateTime end = DateTime.UtcNow + SecureSession.Patience;
        while (!until())
        {
            if (session.State == SessionState.Ended || DateTime.UtcNow > end)
            {
                return false;
            }

            session.Step();
            await Task.Delay(1); // as a frame would: the one thread serves the socket meanwhile
        }

        return true;
    }
}
