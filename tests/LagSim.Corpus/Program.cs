using System;
using System.IO;

namespace LagSim.Corpus;

/// <summary>
/// Replays a folder of recordings on the runtime that runs it, and computes its handshake: <c>LagSim.Corpus FOLDER</c>. Or plays one end of
/// a protected session with another runtime: <c>--host</c>, and <c>--join ADDRESS</c>. <c>.ci/corpus</c> runs it on all there are.
/// </summary>
internal static class Program
{
    private static int Main(string[] arguments)
    {
        if (arguments.Length == 1 && arguments[0] == "--host")
        {
            return SecurePeers.Host(Console.Out);
        }

        if (arguments.Length == 2 && arguments[0] == "--join")
        {
            return SecurePeers.Join(arguments[1], Console.Out);
        }

        if (arguments.Length != 1)
        {
            Console.Error.WriteLine("usage: LagSim.Corpus FOLDER, a folder of recordings (*.lagsim); or --host; or --join ADDRESS");
            return 2;
        }

        try
        {
            return CorpusCheck.Run(arguments[0], Console.Out);
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            Console.Error.WriteLine(failure.Message);
            return 3;
        }
    }
}
