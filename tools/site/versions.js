// versions.js - a choice of the other versions of the site, whose name says which one this is.
//
// Sites of several versions are in directories named after them; beside these directories is the versions-list.js of
// the newest, so that an old site leads to newer ones.  A site that is alone has nothing to choose.
{
    const site = new URL('.', document.currentScript.src);
    // The same page of another version where it has it; its front page otherwise.
    const open = async version => {
        const other = new URL(`../${version}/`, site), page = new URL(location.href.split('#')[0].slice(site.href.length), other);
        const isThere = await fetch(page, {method: 'HEAD'}).then(found => found.ok, () => false);
        location.assign(isThere ? page : new URL('index.html', other));
    };
    window.showVersions = versions => {
        if (versions.length < 2) return;
        const choice = document.createElement('select');
        choice.setAttribute('aria-label', 'Version');
        choice.className = 'version';
        for (const version of versions) choice.add(new Option(version, version));
        choice.value = window.DALEMBERT_VERSION;
        choice.addEventListener('change', () => open(choice.value));
        document.querySelector('.md-header__title').after(choice);
    };
    document.addEventListener('DOMContentLoaded', () => {
        const script = document.createElement('script');
        script.src = new URL('../versions-list.js', site);
        document.head.append(script);
    });
}
